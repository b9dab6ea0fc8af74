// Pictures that go on from the last one: with what was found about it while few samples have come, and anew then.
#include "recon/picture/guided.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 70, height = 50;

/// Of so many samples, the brightest of which are spikes in some pixels.
GradientImages images_of(int samples, std::uint32_t seed = 3) {
    GradientImages images = noisy_images(width, height, 1, seed);
    images.patch = 4;
    const auto n = static_cast<float>(samples);
    images.brightest = {images.primal, images.dx, images.dy, {}, Image<float>(width, height, 1), samples};
    for (std::size_t i = 0; i < images.primal.size(); i += 211) {
        images.brightest.primal.data()[i] += Rgb(9 * n);
        images.primal.data()[i] += Rgb(9);
    }
    return images;
}

ReconstructionSettings settings_of(Norm norm) {
    return {.norm = norm};
}

/// A reconstructor that has made two pictures, and so keeps what it found about the second.
void make_two(const GradientImages& images, const ReconstructionSettings& settings, Reconstructor& reconstructor) {
    reconstructor.reconstruct(images, settings);
    reconstructor.reconstruct(images, settings);
}

double difference(const RgbImage& a, const RgbImage& b) {
    return relative_difference(a, b);
}

/// `smoothed` has no solver, whose start differs; all else is found anew by one that has no picture before.
TEST(GoingOn, MakesTheSameOfTheSame) {
    const GradientImages images = images_of(8);
    Reconstructor reconstructor;
    const RgbImage first = reconstructor.reconstruct(images, settings_of(Norm::smoothed)).image;
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(difference(reconstructor.reconstruct(images, settings_of(Norm::smoothed)).image, first), 0) << i;
}

TEST(GoingOn, OfAFewSamplesMoreIsAsGoodAsAnew) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
    const GradientImages before = images_of(8), after = images_of(9, 4);
    for (const Norm norm : {Norm::weighted, Norm::guided, Norm::smoothed}) {
        Reconstructor reconstructor;
        make_two(before, settings_of(norm), reconstructor);
        const Reconstruction third = reconstructor.reconstruct(after, settings_of(norm));
        const RgbImage anew = reconstruct(after, settings_of(norm)).image;
        EXPECT_TRUE(third.goes_on) << to_string(norm);
        EXPECT_EQ(third.iterations, norm == Norm::smoothed ? 0 : 2) << to_string(norm);
        EXPECT_GT(difference(third.image, anew), 0) << to_string(norm);
        EXPECT_LT(relative_rms_difference(third.image, truth), 1.05 * relative_rms_difference(anew, truth))
            << to_string(norm);
    }
}

/// Whether the third picture goes on, the first two of which were of `before`. Then it is another than anew.
bool goes_on(const GradientImages& before, const GradientImages& images, const ReconstructionSettings& settings,
             const ReconstructionSettings& asked, const std::function<void(Reconstructor&)>& between = {}) {
    Reconstructor reconstructor;
    make_two(before, settings, reconstructor);
    if (between)
        between(reconstructor);
    const Reconstruction third = reconstructor.reconstruct(images, asked);
    if (asked.norm == Norm::smoothed) { // has no solver, whose start differs
        EXPECT_EQ(difference(third.image, reconstruct(images, asked).image) > 0, third.goes_on);
    }
    return third.goes_on;
}

TEST(GoingOn, IsOverWhereThePictureIsAnother) {
    const GradientImages before = images_of(8), more = images_of(9, 4);
    for (const Norm norm : {Norm::smoothed, Norm::guided, Norm::weighted}) {
        const ReconstructionSettings settings = settings_of(norm);
        ReconstructionSettings spiky = settings, softer = settings;
        spiky.spikes = Spikes::off;
        softer.alpha = 0.1f;
        EXPECT_TRUE(goes_on(before, more, settings, settings));
        EXPECT_FALSE(goes_on(before, images_of(10, 4), settings, settings)); // a quarter more
        EXPECT_FALSE(goes_on(before, images_of(7, 4), settings, settings));
        EXPECT_FALSE(goes_on(before, more, settings, spiky));
        EXPECT_FALSE(goes_on(before, more, settings, softer));
        EXPECT_FALSE(goes_on(before, more, settings, settings, [](Reconstructor& r) { r.forget(); }));
        EXPECT_FALSE(goes_on(before, more, settings, settings, [](Reconstructor& r) { r.set_keeps(false); }));
        EXPECT_FALSE(goes_on(before, more, settings, settings, [&](Reconstructor& r) {
            r.reconstruct(noisy_images(30, 20), settings); // of another size
        }));
        EXPECT_FALSE(goes_on(before, more, settings, settings, [&](Reconstructor& r) {
            std::stop_source stop;
            stop.request_stop();
            r.reconstruct(more, settings, serial_for, SolveWatch(stop.get_token()));
        }));
        Reconstructor once; // the first picture's is not kept: most have no second
        once.reconstruct(before, settings);
        EXPECT_EQ(once.bytes_kept(), 0u);
        EXPECT_FALSE(once.reconstruct(more, settings).goes_on);
        EXPECT_GT(once.bytes_kept(), 0u);
        Reconstructor early; // with four samples each more is a quarter
        make_two(images_of(4), settings, early);
        EXPECT_EQ(early.bytes_kept(), 0u);
    }
}

/// What was found is not asked of images that come with others than before.
TEST(GoingOn, IsOverWhereImagesComeOrGo) {
    using Change = std::function<void(GradientImages&)>;
    const Change changes[] = {
        [](GradientImages& images) { images.halves = {}; },
        [](GradientImages& images) { images.guides = {}; },
        [](GradientImages& images) {
            images.dx = images.dy = {};
            images.dx_variance = images.dy_variance = {};
        },
        [](GradientImages& images) { images.primal_variance = {}; },
        [](GradientImages& images) { images.brightest.primal = {}; },
        [](GradientImages& images) { images.patch = 2; },
    };
    for (const Norm norm : {Norm::smoothed, Norm::guided, Norm::weighted})
        for (const Change& change : changes) {
            GradientImages before = images_of(8), more = images_of(9, 4);
            EXPECT_TRUE(goes_on(before, more, settings_of(norm), settings_of(norm)));
            change(more);
            const bool is_seen = norm != Norm::weighted || !more.halves.empty(); // it has no use for them
            EXPECT_EQ(goes_on(before, more, settings_of(norm), settings_of(norm)), !is_seen) << to_string(norm);
            change(before);
            EXPECT_EQ(goes_on(before, images_of(9, 4), settings_of(norm), settings_of(norm)), !is_seen)
                << to_string(norm);
        }
}

/// Pictures that are not smoothed anew are not smoothed likewise.
TEST(GoingOn, LeavesBlackAndEndlessPicturesAlone) {
    ReconstructionSettings settings = settings_of(Norm::smoothed);
    settings.spikes = Spikes::off; // spread, what is not finite would be all over the picture
    const auto black = [](GradientImages images) {
        std::fill(images.primal.begin(), images.primal.end(), Rgb(0));
        std::fill(images.brightest.primal.begin(), images.brightest.primal.end(), Rgb(0));
        return images;
    };
    const auto endless = [](GradientImages images) {
        images.primal(20, 20) = Rgb(std::numeric_limits<float>::infinity());
        return images;
    };
    EXPECT_FALSE(goes_on(black(images_of(8)), images_of(9, 4), settings, settings));
    EXPECT_FALSE(goes_on(endless(images_of(8)), images_of(9, 4), settings, settings));
    Reconstructor reconstructor;
    make_two(images_of(8), settings, reconstructor);
    const RgbImage image = reconstructor.reconstruct(endless(images_of(9, 4)), settings).image;
    EXPECT_TRUE(std::isfinite(image(30, 20).g) && std::isfinite(image(20, 30).g));
    for (const Rgb c : reconstructor.reconstruct(black(images_of(9, 4)), settings).image)
        ASSERT_EQ(c, Rgb(0));
}

TEST(GoingOn, HasTheSameBitsForAnyThreads) {
    const GradientImages before = images_of(8), after = images_of(9, 4);
    const auto third = [&](const ParallelFor& parallel_for) {
        Reconstructor reconstructor;
        for (const GradientImages* images : {&before, &before, &after})
            if (RgbImage image = reconstructor.reconstruct(*images, {}, parallel_for).image; images == &after)
                return image;
        return RgbImage();
    };
    EXPECT_EQ(difference(third(backwards_for), third(serial_for)), 0);
}

TEST(GoingOn, SmoothsLikewise) {
    const GradientImages images = images_of(8);
    const AlikePixels alike({width, height}, images.guides, serial_for);
    SmoothingFit fit;
    const RgbImage smooth =
        smooth_by_guides({images.primal, images.halves.primal}, images.guides, alike, serial_for, {}, &fit).image;
    ASSERT_FALSE(fit.empty());
    EXPECT_EQ(difference(smooth_likewise(images.primal, images.guides, alike, fit, serial_for), smooth), 0);
    RgbImage twice = images.primal, twice_smooth = smooth; // floats tell twice as exactly
    for (RgbImage* image : {&twice, &twice_smooth})
        for (Rgb& c : *image)
            c *= 2;
    EXPECT_EQ(difference(smooth_likewise(twice, images.guides, alike, fit, serial_for), twice_smooth), 0);
}

} // namespace

} // namespace tessera::test
