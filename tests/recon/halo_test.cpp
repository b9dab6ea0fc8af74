// Halos: how a firefly changes the rest of a picture.
#include "recon/metrics/halo.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 48, height = 36, samples = 10;
constexpr float wall_variance = 1; // pixels may have three times the radiance of their samples

/// Returns a wall of radiance 1 with tiles of 4x4 pixels. One sample of the tile at (20, 16) is a firefly, which
/// is not in the gradients.
GradientImages wall_with_firefly(float radiance) {
    GradientImages images;
    BrightestSamples& b = images.brightest;
    images.primal = b.primal = RgbImage(width, height, Rgb(1));
    images.dx = images.dy = b.dx = b.dy = images.very_direct = RgbImage(width, height, Rgb(0));
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(width, height, wall_variance);
    images.patch = 4;
    b.samples = samples;
    for (int y = 16; y < 20; ++y)
        for (int x = 20; x < 24; ++x) {
            b.primal(x, y) = Rgb(radiance);
            images.primal(x, y) = Rgb((samples - 1 + radiance) / samples);
            images.primal_variance(x, y) = 3 * (radiance - 1) * (radiance - 1) / (samples * samples);
        }
    return images;
}

TEST(Halo, IsFoundAroundTheBrightestSample) {
    const std::optional<Halo> halo = measure_halo(wall_with_firefly(1000), {.norm = Norm::none}, serial_for);
    ASSERT_TRUE(halo);
    EXPECT_TRUE((PixelRect{20, 16, 24, 20}.contains(halo->firefly)));
    EXPECT_FALSE(measure_halo(wall_with_firefly(1), {}, serial_for)); // no sample is brighter than the others
    GradientImages large = wall_with_firefly(1000);
    large.patch = 48; // the square is the whole picture
    EXPECT_FALSE(measure_halo(large, {}, serial_for));
    GradientImages without_samples = wall_with_firefly(1000);
    without_samples.brightest = {};
    EXPECT_FALSE(measure_halo(without_samples, {}, serial_for));
}

/// `none` keeps the energy in the tile. `l2` spreads a blob around it, and redistribution a uniform glow.
TEST(Halo, DistinguishesABlobFromRedistributedEnergy) {
    const GradientImages images = wall_with_firefly(1000);
    const auto halo = [&](Norm norm) { return *measure_halo(images, {.norm = norm}, serial_for); };
    EXPECT_EQ(halo(Norm::none).energy, 0);
    const Halo l2 = halo(Norm::l2), smoothed = halo(Norm::smoothed);
    EXPECT_GT(l2.energy, 0.3);
    EXPECT_GT(l2.peak, 1);
    EXPECT_GT(smoothed.energy, 0.3);
    EXPECT_LT(smoothed.peak, 0.5 * l2.peak);
}

/// The mean of the other samples replaces the brightest sample, and variances are over the other samples.
TEST(Halo, WithoutTheBrightestSampleIsTheMeanOfTheOthers) {
    const GradientImages without = without_brightest(wall_with_firefly(1000), {20, 16, 24, 20});
    for (const Rgb& c : without.primal)
        EXPECT_NEAR(c.r, 1, 1e-5);
    EXPECT_NEAR(without.primal_variance(21, 17), 0, 1e-2); // 3e4 with the firefly
    EXPECT_EQ(without.primal_variance(2, 2), wall_variance);
    EXPECT_EQ(without.brightest.primal(2, 2).r, 1);
    EXPECT_NEAR(without.brightest.primal(21, 17).r, 1, 1e-4);
}

} // namespace

} // namespace tessera::test
