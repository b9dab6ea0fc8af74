// What a spike does to the rest of a picture.
#include "recon/metrics/halo.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 48, height = 36, samples = 10;

/// A wall of 1 in tiles of 4; in one sample of the tile at (20, 16) light of 1000. Its gradients know nothing of
/// that inside the tile, and all of it at the border.
GradientImages wall_with_spike(float spike) {
    GradientImages images;
    BrightestSamples& b = images.brightest;
    images.primal = b.primal = RgbImage(width, height, Rgb(1));
    images.dx = images.dy = b.dx = b.dy = images.very_direct = RgbImage(width, height, Rgb(0));
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(width, height, 1e-4f);
    images.patch = 4;
    b.samples = samples;
    for (int y = 16; y < 20; ++y)
        for (int x = 20; x < 24; ++x) {
            b.primal(x, y) = Rgb(spike);
            images.primal(x, y) = Rgb((samples - 1 + spike) / samples);
            images.primal_variance(x, y) = 3 * (spike - 1) * (spike - 1) / (samples * samples);
        }
    return images;
}

TEST(Halo, IsThatOfTheBrightestSample) {
    const std::optional<Halo> halo = measure_halo(wall_with_spike(1000), {.norm = Norm::none}, serial_for);
    ASSERT_TRUE(halo);
    EXPECT_TRUE((PixelRect{20, 16, 24, 20}.contains(halo->spike)));
    EXPECT_FALSE(measure_halo(wall_with_spike(1), {}, serial_for)); // no sample is above the others
    GradientImages large = wall_with_spike(1000);
    large.patch = 48; // the square has the whole picture
    EXPECT_FALSE(measure_halo(large, {}, serial_for));
    GradientImages unknown = wall_with_spike(1000);
    unknown.brightest = {};
    EXPECT_FALSE(measure_halo(unknown, {}, serial_for));
}

/// Without a solver and without spreading nothing leaves the tile; what L2 makes of it does, and far more strongly
/// so than light that is held back and spread.
TEST(Halo, TellsBlobsFromSpreadLight) {
    const GradientImages images = wall_with_spike(1000);
    const auto halo = [&](Norm norm, Spikes spikes) {
        return *measure_halo(images, {.norm = norm, .spikes = spikes}, serial_for);
    };
    EXPECT_EQ(halo(Norm::none, Spikes::off).energy, 0);
    const Halo l2 = halo(Norm::l2, Spikes::off);
    EXPECT_GT(l2.energy, 0.3);
    EXPECT_GT(l2.peak, 1);
    EXPECT_LT(halo(Norm::none, Spikes::consistent).peak, 0.5 * l2.peak);
}

/// In the place of the brightest sample is the mean of the others, and variances are theirs.
TEST(Halo, WithoutBrightestIsTheMeanOfOthers) {
    const GradientImages without = without_brightest(wall_with_spike(1000), {20, 16, 24, 20});
    for (const Rgb& c : without.primal)
        EXPECT_NEAR(c.r, 1, 1e-5);
    EXPECT_NEAR(without.primal_variance(21, 17), 0, 1e-2); // of what was 3e4
    EXPECT_EQ(without.primal_variance(2, 2), 1e-4f);
    EXPECT_EQ(without.brightest.primal(2, 2).r, 1);
    EXPECT_NEAR(without.brightest.primal(21, 17).r, 1, 1e-4);
}

} // namespace

} // namespace tessera::test
