// Spikes: what is held back, where it goes, and that nothing is lost.
#include "recon/picture/light_spreader.h"
#include "recon/picture/reconstruct.h"
#include "recon/picture/spikes.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 40, height = 30;

/// Samples of every pixel, and the images that a film makes of them, without a basis.
struct Samples {
    explicit Samples(int n) : of(static_cast<std::size_t>(n), RgbImage(width, height, Rgb(1))) {}

    GradientImages images() const {
        const double n = static_cast<double>(of.size());
        GradientImages result;
        BrightestSamples& b = result.brightest;
        for (RgbImage* image : {&result.primal, &result.dx, &result.dy, &b.primal, &b.dx, &b.dy})
            *image = RgbImage(width, height, Rgb(0));
        for (Image<float>* image : {&result.primal_variance, &result.dx_variance, &result.dy_variance})
            *image = Image<float>(width, height);
        b.samples = static_cast<int>(of.size());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                double sum = 0, squares = 0;
                Rgb sum_x(0), sum_y(0);
                float most = 0;
                for (const RgbImage& s : of) {
                    const Rgb here = s(x, y), dx = x + 1 < width ? s(x + 1, y) - here : Rgb(0),
                              dy = y + 1 < height ? s(x, y + 1) - here : Rgb(0);
                    sum += static_cast<double>(here.r);
                    squares += 3 * static_cast<double>(here.r * here.r);
                    sum_x += dx;
                    sum_y += dy;
                    if (const float size = std::max({here.r, std::abs(dx.r), std::abs(dy.r)}); size > most) {
                        most = size;
                        b.primal(x, y) = here;
                        b.dx(x, y) = dx;
                        b.dy(x, y) = dy;
                    }
                }
                result.primal(x, y) = Rgb(static_cast<float>(sum / n));
                result.dx(x, y) = sum_x / static_cast<float>(n);
                result.dy(x, y) = sum_y / static_cast<float>(n);
                result.primal_variance(x, y) = static_cast<float>((squares - 3 * sum * sum / n) / (n * (n - 1)));
            }
        return result;
    }

    std::vector<RgbImage> of;
};

/// One sample in 16 of 6x6 pixels that is 1000 times as bright.
Samples with_spike() {
    Samples samples(16);
    for (int y = 10; y < 16; ++y)
        for (int x = 12; x < 18; ++x)
            samples.of[5](x, y) = Rgb(1000);
    return samples;
}

TEST(Spikes, WeighNoMoreThanAQuarterOfAllOthers) {
    RgbImage held;
    const GradientImages images = limited(with_spike().images(), true, held, serial_for);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_lit = x >= 12 && x < 18 && y >= 10 && y < 16;
            EXPECT_NEAR(images.primal(x, y).r, is_lit ? 19 / 16.0 : 1, 1e-3) << x << ' ' << y;
            EXPECT_NEAR(held(x, y).g, is_lit ? 996 / 16.0 : 0, 1e-3) << x << ' ' << y;
        }
}

/// Within a tile that was lit all over, and at its border, where gradients beyond it know nothing of it.
TEST(Spikes, GradientsStayDifferences) {
    constexpr double ordinary = 1.01 / 16; // what of a limited sample was no spike, and is limited with it
    RgbImage held;
    const GradientImages images = limited(with_spike().images(), true, held, serial_for);
    for (int y = 0; y + 1 < height; ++y)
        for (int x = 0; x + 1 < width; ++x) {
            EXPECT_NEAR(images.dx(x, y).r, images.primal(x + 1, y).r - images.primal(x, y).r, ordinary);
            EXPECT_NEAR(images.dy(x, y).r, images.primal(x, y + 1).r - images.primal(x, y).r, ordinary);
        }
}

/// How little is known of a pixel is not forgotten when its spike is limited: solvers are to trust others there.
TEST(Spikes, VariancesStay) {
    const GradientImages images = with_spike().images();
    RgbImage held;
    const GradientImages result = limited(images, true, held, serial_for);
    EXPECT_EQ(result.primal_variance(15, 13), images.primal_variance(15, 13));
    EXPECT_GT(result.primal_variance(15, 13), 1000);
}

/// But what light alone makes of a picture's product with albedos is that of limited samples: here 15 of 1, and 4.
TEST(Spikes, UnexplainedVariancesAreOfLimitedSamples) {
    GradientImages images = with_spike().images();
    const RgbImage black(width, height), white(width, height, Rgb(1));
    const Image<float> none(width, height);
    images.demodulation = {images.primal, white, white, none, none, black, black, images.primal_variance};
    images.brightest.albedo = white;
    RgbImage held;
    const GradientImages result = limited(images, true, held, serial_for);
    const double mean = 19.0 / 16, squares = 15 * (1 - mean) * (1 - mean) + (4 - mean) * (4 - mean);
    EXPECT_NEAR(result.demodulation.unexplained_variance(15, 13), 3 * squares / (16 * 15), 1e-3);
    EXPECT_EQ(result.demodulation.unexplained_variance(3, 3), images.primal_variance(3, 3));
}

TEST(Spikes, NoLightIsLost) {
    const GradientImages images = with_spike().images();
    RgbImage held;
    RgbImage picture = limited(images, true, held, serial_for).primal;
    EXPECT_NEAR(sum_of(picture) + sum_of(held), sum_of(images.primal), 1e-5 * sum_of(images.primal));
    EXPECT_GT(sum_of(held), 0.5 * sum_of(images.primal));
    spread_around(held, lit_surroundings(picture, anywhere(picture), {}, serial_for), picture, serial_for);
    EXPECT_NEAR(sum_of(picture), sum_of(images.primal), 1e-5 * sum_of(images.primal));
    float most = 0;
    for (Rgb c : picture)
        most = std::max(most, c.r);
    EXPECT_LT(most, 10); // and it is no spike any more: 63 before
}

/// One sample in a thousand of any pixel finds all its light: what is held of those that did goes to all, and not
/// to those few again.
TEST(Spikes, OfRareLightAreNotMadeAnew) {
    Samples samples(4);
    std::mt19937 random(7);
    for (RgbImage& sample : samples.of)
        for (Rgb& c : sample)
            c = Rgb(random() % 1000 == 0 ? 1000.0f : 0.0f);
    const GradientImages images = samples.images();
    const auto error_of = [](const RgbImage& image) {
        double sum = 0;
        for (Rgb c : image)
            sum += std::pow(static_cast<double>(c.r) - 1, 2);
        return sum / static_cast<double>(image.size());
    };
    RgbImage held;
    RgbImage picture = limited(images, true, held, serial_for).primal;
    spread_around(held, lit_surroundings(picture, anywhere(picture), {}, serial_for), picture, serial_for);
    EXPECT_LT(error_of(picture), 0.1 * error_of(images.primal));
}

/// A pixel that is brighter than all about it, and whose samples all say so, stays as it is.
TEST(Spikes, FeaturesOfOnePixelAreNone) {
    for (const int n : {2, 3, 4, 5, 6, 7, 16}) {
        Samples samples(n);
        for (RgbImage& sample : samples.of)
            sample(9, 9) = Rgb(300);
        const GradientImages images = samples.images();
        RgbImage held;
        const RgbImage primal = limited(images, true, held, serial_for).primal;
        EXPECT_EQ(sum_of(held), 0) << n;
        EXPECT_EQ(primal(9, 9).r, 300);
    }
}

/// With samples the same spike comes through: more and more of it counts.
TEST(Spikes, CountInFullInTheEnd) {
    for (const int n : {40, 4000}) {
        GradientImages images;
        images.primal = RgbImage(width, height, Rgb(1));
        images.primal(9, 9) = Rgb(1 + 100.0f / static_cast<float>(n));
        images.brightest.primal = RgbImage(width, height, Rgb(1));
        images.brightest.primal(9, 9) = Rgb(101);
        images.brightest.samples = n;
        RgbImage held;
        const GradientImages result = limited(images, true, held, serial_for);
        if (n == 40)
            EXPECT_NEAR(held(9, 9).r, 91 / 40.0, 1e-3);
        else
            EXPECT_EQ(sum_of(held), 0);
    }
}

/// Ordinary noise is left alone, and so are edges, however few samples there are.
TEST(Spikes, ThereAreNoneWhereSamplesAreAlike) {
    for (const int n : {2, 3, 16}) {
        Samples samples(n);
        std::mt19937 random(3);
        for (RgbImage& sample : samples.of)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    sample(x, y) =
                        Rgb((x < 20 ? 1.0f : 50.0f) * (0.8f + 0.4f * static_cast<float>(random()) / 4.3e9f));
        EXPECT_EQ(sum_of(held_light(samples.images())), 0) << n;
    }
}

/// Of exponential noise, whose largest of 16 samples is 3.4 times its mean, a few hundredths: E(x - 4 mu)+ is 0.02
/// to 0.04 of it, by the mean of the others.
TEST(Spikes, AreFewInOrdinaryNoise) {
    Samples samples(16);
    std::mt19937 random(5);
    std::exponential_distribution<float> noise;
    for (RgbImage& sample : samples.of)
        for (Rgb& c : sample)
            c = Rgb(noise(random));
    const GradientImages images = samples.images();
    EXPECT_LT(sum_of(held_light(images)), 0.05 * sum_of(images.primal));
}

TEST(Spikes, OfOneSampleOrOfPartsNothingIsHeldBack) {
    GradientImages images = with_spike().images();
    EXPECT_TRUE(can_limit(images));
    images.brightest.samples = 1;
    EXPECT_FALSE(can_limit(images));
    images.brightest.samples = 16;
    images.parts.emplace_back();
    EXPECT_FALSE(can_limit(images));
    images.parts.clear();
    images.brightest = {};
    EXPECT_FALSE(can_limit(images));
}

/// The picture of every norm is without the spike, and has its light; with `off` it stays.
TEST(Spikes, AreNotSeenInPictures) {
    const GradientImages images = with_spike().images();
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // takes a library that may not be there
        const Reconstruction held = reconstruct(images, {.norm = norm}),
                             full = reconstruct(images, {.norm = norm, .spikes = Spikes::off});
        EXPECT_LT(held.image(15, 13).r, 10) << to_string(norm);
        EXPECT_GT(held.held_share, 0.5);
        if (norm != Norm::l1) {
            EXPECT_GT(full.image(15, 13).r, 40) << to_string(norm);
            EXPECT_NEAR(sum_of(held.image), sum_of(full.image), 0.01 * sum_of(full.image)) << to_string(norm);
        }
        EXPECT_EQ(full.held_share, 0);
    }
}

} // namespace

} // namespace tessera::test
