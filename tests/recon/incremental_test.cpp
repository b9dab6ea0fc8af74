// Incremental reconstruction: pictures of a few more samples reuse the weights of an earlier picture.
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

/// Returns images of so many samples, with fireflies.
GradientImages images_of(int samples, std::uint32_t seed = 3) {
    GradientImages images = noisy_images(width, height, 1, seed);
    images.patch = 4;
    add_fireflies(images, samples);
    return images;
}

ReconstructionSettings settings_of(Norm norm) {
    return {.norm = norm};
}

/// Makes two pictures. The reconstructor keeps the weights of the second one.
void make_two(const GradientImages& images, const ReconstructionSettings& settings, Reconstructor& reconstructor) {
    reconstructor.reconstruct(images, settings);
    reconstructor.reconstruct(images, settings);
}

constexpr Norm incremental[] = {Norm::guided, Norm::smoothed};

/// Only for `smoothed`: the solver of `guided` would start from another picture.
TEST(Incremental, GivesTheSameBitsForTheSameSamples) {
    const GradientImages images = images_of(8);
    Reconstructor reconstructor;
    const ReconstructionSettings settings = settings_of(Norm::smoothed);
    const RgbImage first = reconstructor.reconstruct(images, settings).image;
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(has_same_bits(reconstructor.reconstruct(images, settings).image, first)) << i;
}

TEST(Incremental, HasTheErrorOfAFullReconstruction) {
    const RgbImage truth = steps_and_ramps(width, height);
    const GradientImages before = images_of(8), after = images_of(9, 4);
    for (const Norm norm : incremental) {
        Reconstructor reconstructor;
        make_two(before, settings_of(norm), reconstructor);
        const Reconstruction third = reconstructor.reconstruct(after, settings_of(norm));
        const RgbImage full = reconstruct(after, settings_of(norm)).image;
        EXPECT_TRUE(third.goes_on) << to_string(norm);
        EXPECT_EQ(third.iterations > 0, norm == Norm::guided);
        EXPECT_FALSE(has_same_bits(third.image, full)) << to_string(norm);
        EXPECT_LT(relative_rms_difference(third.image, truth), 1.05 * relative_rms_difference(full, truth))
            << to_string(norm);
    }
}

TEST(Incremental, TakesFewerStepsOfTheSolver) {
    const GradientImages images = images_of(8);
    Reconstructor reconstructor;
    make_two(images, settings_of(Norm::guided), reconstructor);
    EXPECT_LT(reconstructor.reconstruct(images_of(9, 4), settings_of(Norm::guided)).iterations,
              reconstruct(images, settings_of(Norm::guided)).iterations);
}

/// Returns whether the picture of `images` with `next_settings` uses the weights of two pictures of `before`.
/// @param between  called before the third picture
bool goes_on(const GradientImages& before, const GradientImages& images, const ReconstructionSettings& settings,
             const ReconstructionSettings& next_settings,
             const std::function<void(Reconstructor&)>& between = {}) {
    Reconstructor reconstructor;
    make_two(before, settings, reconstructor);
    if (between)
        between(reconstructor);
    const Reconstruction third = reconstructor.reconstruct(images, next_settings);
    if (next_settings.norm == Norm::smoothed) {
        EXPECT_EQ(has_same_bits(third.image, reconstruct(images, next_settings).image), !third.goes_on);
    }
    return third.goes_on;
}

TEST(Incremental, EndsWithOtherSettingsOrSamples) {
    const GradientImages before = images_of(8), after = images_of(9, 4);
    for (const Norm norm : incremental) {
        const ReconstructionSettings settings = settings_of(norm);
        ReconstructionSettings softer = settings;
        softer.alpha = 0.1f;
        EXPECT_TRUE(goes_on(before, after, settings, settings));
        EXPECT_FALSE(goes_on(before, images_of(10, 4), settings, settings)); // a quarter more samples
        EXPECT_FALSE(goes_on(before, images_of(7, 4), settings, settings));
        EXPECT_FALSE(goes_on(before, after, settings, softer));
        EXPECT_FALSE(goes_on(before, after, settings, settings, [](Reconstructor& r) { r.forget(); }));
        EXPECT_FALSE(goes_on(before, after, settings, settings, [](Reconstructor& r) { r.set_keeps(false); }));
        EXPECT_FALSE(goes_on(before, after, settings, settings,
                             [](Reconstructor& r) { r.set_parameters(GuidedParameters()); }));
        EXPECT_FALSE(goes_on(before, after, settings, settings,
                             [&](Reconstructor& r) { r.reconstruct(before, settings_of(Norm::l2)); }));
        EXPECT_FALSE(goes_on(before, after, settings, settings, [&](Reconstructor& r) {
            r.reconstruct(noisy_images(30, 20), settings); // another size
        }));
        EXPECT_FALSE(goes_on(before, after, settings, settings, [&](Reconstructor& r) {
            std::stop_source stop;
            stop.request_stop();
            r.reconstruct(after, settings, serial_for, SolveWatch(stop.get_token()));
        }));
        Reconstructor once; // keeps nothing of the first picture, because often no second one follows
        once.reconstruct(before, settings);
        EXPECT_EQ(once.bytes_kept(), 0u);
        EXPECT_FALSE(once.reconstruct(after, settings).goes_on);
        EXPECT_GT(once.bytes_kept(), 0u);
        Reconstructor early; // at four samples, each further one adds a quarter
        make_two(images_of(4), settings, early);
        EXPECT_EQ(early.bytes_kept(), 0u);
    }
}

TEST(Incremental, EndsWhereImagesAreAddedOrRemoved) {
    using Change = std::function<void(GradientImages&)>;
    const Change changes[] = {
        [](GradientImages& images) { images.halves = {}; },
        [](GradientImages& images) { images.features = {}; },
        [](GradientImages& images) {
            images.dx = images.dy = {};
            images.dx_variance = images.dy_variance = {};
        },
        [](GradientImages& images) { images.primal_variance = {}; },
        [](GradientImages& images) { images.brightest.primal = {}; },
        [](GradientImages& images) { images.patch = 2; },
    };
    for (const Norm norm : incremental)
        for (const Change& change : changes) {
            GradientImages before = images_of(8), after = images_of(9, 4);
            EXPECT_TRUE(goes_on(before, after, settings_of(norm), settings_of(norm)));
            change(after);
            EXPECT_FALSE(goes_on(before, after, settings_of(norm), settings_of(norm))) << to_string(norm);
            change(before);
            EXPECT_FALSE(goes_on(before, images_of(9, 4), settings_of(norm), settings_of(norm)))
                << to_string(norm);
        }
}

/// The filter leaves an infinite picture unchanged, and finds no weights.
TEST(Incremental, DoesNotStartFromAnInfinitePicture) {
    const ReconstructionSettings settings = settings_of(Norm::smoothed);
    const auto infinite = [](GradientImages images) {
        const int samples = images.brightest.samples;
        images.brightest = {};
        images.brightest.samples = samples;
        images.primal(20, 20) = Rgb(std::numeric_limits<float>::infinity());
        return images;
    };
    Reconstructor reconstructor;
    make_two(infinite(images_of(8)), settings, reconstructor);
    EXPECT_EQ(reconstructor.bytes_kept(), 0u);
    EXPECT_FALSE(reconstructor.reconstruct(infinite(images_of(9, 4)), settings).goes_on);
}

TEST(Incremental, OfAnInfiniteSampleIsFiniteElsewhere) {
    const auto without_brightest = [](GradientImages images) {
        const int samples = images.brightest.samples;
        images.brightest = {};
        images.brightest.samples = samples;
        return images;
    };
    Reconstructor reconstructor;
    make_two(without_brightest(images_of(8)), settings_of(Norm::smoothed), reconstructor);
    GradientImages images = without_brightest(images_of(9, 4));
    images.primal(20, 20) = Rgb(std::numeric_limits<float>::infinity());
    const Reconstruction third = reconstructor.reconstruct(images, settings_of(Norm::smoothed));
    EXPECT_TRUE(third.goes_on);
    EXPECT_TRUE(std::isfinite(third.image(30, 20).g) && std::isfinite(third.image(20, 30).g));
}

/// The weights of a black picture must not lose the energy of the next one.
TEST(Incremental, FromABlackPictureKeepsTheEnergy) {
    const auto without_brightest = [](GradientImages images) {
        const int samples = images.brightest.samples;
        images.brightest = {};
        images.brightest.samples = samples;
        return images;
    };
    GradientImages black = without_brightest(images_of(8));
    for (RgbImage* image :
         {&black.primal, &black.dx, &black.dy, &black.halves.primal, &black.halves.dx, &black.halves.dy})
        for (Rgb& c : *image)
            c = Rgb(0);
    for (Image<float>* variances : {&black.primal_variance, &black.dx_variance, &black.dy_variance})
        for (float& v : *variances)
            v = 0;
    for (const Norm norm : incremental) {
        Reconstructor reconstructor;
        make_two(black, settings_of(norm), reconstructor);
        const GradientImages lit = without_brightest(images_of(9, 4));
        const RgbImage picture = reconstructor.reconstruct(lit, settings_of(norm)).image;
        EXPECT_NEAR(sum_of(picture), sum_of(lit.primal), 0.02 * sum_of(lit.primal)) << to_string(norm);
        for (const Rgb c : reconstructor.reconstruct(black, settings_of(norm)).image)
            ASSERT_EQ(c, Rgb(0)) << to_string(norm);
    }
}

TEST(Incremental, HasTheSameBitsWithThreads) {
    const GradientImages before = images_of(8), after = images_of(9, 4);
    const auto third = [&](const ParallelFor& parallel_for) {
        Reconstructor reconstructor;
        for (const GradientImages* images : {&before, &before, &after})
            if (RgbImage image = reconstructor.reconstruct(*images, {}, parallel_for).image; images == &after)
                return image;
        return RgbImage();
    };
    EXPECT_TRUE(has_same_bits(third(backwards_for), third(serial_for)));
}

} // namespace

} // namespace tessera::test
