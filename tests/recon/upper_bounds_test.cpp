// Upper bounds of pixels by their own samples, the last stage of the denoiser.
#include "recon/guided/upper_bounds.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 40, height = 30, bar = 20;

/// Returns a wall of radiance 1 with a dark bar one pixel wide. All samples of the bar are dark; those of the wall
/// have the given variance. Without features, all pixels are similar.
GradientImages wall_with_bar(float wall_variance) {
    GradientImages images;
    images.primal = RgbImage(width, height, Rgb(1));
    images.primal_variance = Image<float>(width, height, wall_variance);
    images.patch = 4;
    for (int y = 0; y < height; ++y) {
        images.primal(bar, y) = Rgb(0.01f);
        images.primal_variance(bar, y) = 0;
    }
    return images;
}

RgbImage bounds_of(const GradientImages& images) {
    const GuidedParameters parameters;
    const FeatureKernels kernels({width, height}, images.features, parameters, serial_for);
    return upper_bounds(images, kernels, parameters, serial_for);
}

TEST(UpperBounds, AreTwoStandardErrorsAboveThePrimal) {
    GradientImages images = wall_with_bar(0.25f);
    for (float& v : images.primal_variance)
        v = 0.25f;
    const RgbImage bounds = bounds_of(images);
    EXPECT_NEAR(bounds(5, 10).r, 1 + 2 * 0.5f, 1e-3);
    EXPECT_NEAR(bounds(bar, 10).r, 0.01f + 2 * 0.5f, 1e-3);
}

/// A tile that is dark by chance has no variance. Its bound follows the standard errors of similar pixels.
TEST(UpperBounds, UseTheStandardErrorOfSimilarPixels) {
    const float own = 0.01f;
    EXPECT_GT(bounds_of(wall_with_bar(0.25f))(bar, 10).r, own + 0.5f);
    EXPECT_NEAR(bounds_of(wall_with_bar(1e-8f))(bar, 10).r, own, 1e-3);
}

TEST(UpperBounds, AreAbsentWherePixelsDoNotShareOrFewAreLit) {
    GradientImages images = wall_with_bar(0.25f);
    EXPECT_TRUE(can_bound(images));
    images.patch = 1;
    EXPECT_FALSE(can_bound(images));
    images = wall_with_bar(0.25f);
    images.primal_variance = {};
    EXPECT_FALSE(can_bound(images));
    images = wall_with_bar(0.25f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if ((x + y) % 3 != 0)
                images.primal(x, y) = Rgb(0);
    EXPECT_EQ(bounds_of(images)(12, 12).r, std::numeric_limits<float>::infinity());
}

/// Gradients that missed the bar's edges let the light of the wall leak into it. The stage removes that light, and
/// does not touch the wall.
TEST(UpperBounds, LimitLightThatLeaksIntoADarkBar) {
    GradientImages images = wall_with_bar(1e-6f);
    images.dx = images.dy = RgbImage(width, height, Rgb(0));
    images.dx_variance = images.dy_variance = Image<float>(width, height, 1e-6f);
    images.very_direct = RgbImage(width, height, Rgb(0));
    const auto picture = [&](bool bounds) {
        GuidedParameters parameters;
        parameters.stages.bounds = bounds;
        Reconstructor reconstructor;
        reconstructor.set_parameters(parameters);
        return reconstructor.reconstruct(images, {Norm::guided}).image;
    };
    const RgbImage with = picture(true), without = picture(false);
    EXPECT_GT(without(bar, 15).r, 0.05f);
    EXPECT_LT(with(bar, 15).r, 0.02f);
    EXPECT_NEAR(with(5, 15).r, without(5, 15).r, 1e-3);
}

} // namespace

} // namespace tessera::test
