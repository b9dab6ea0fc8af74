// Weights of gradients, reconstruction (38) to (40).
#include "recon/solvers/edge_weights.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

TEST(EdgeWeights, FallWithTheVarianceOfTheGradient) {
    GradientImages images{RgbImage(30, 20, Rgb(1)), RgbImage(30, 20), RgbImage(30, 20), {}};
    images.primal_variance = Image<float>(30, 20, 2);
    images.dx_variance = images.dy_variance = Image<float>(30, 20, 0.2f);
    for (int y = 0; y < 20; ++y)
        images.dx_variance(29, y) = 0; // there is no gradient
    for (int x = 0; x < 30; ++x)
        images.dy_variance(x, 19) = 0;
    images.dx_variance(15, 10) = 1e6f;
    images.dy_variance(4, 4) = std::numeric_limits<float>::max();
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    const float k = GuidedParameters().edge_noise, usual = 0.04f / (0.04f + k * 0.2f / 2);
    EXPECT_FLOAT_EQ(weights.x(3, 17), usual);
    EXPECT_FLOAT_EQ(weights.y(28, 3), usual);
    EXPECT_FLOAT_EQ(weights.x(28, 17), usual);
    EXPECT_FLOAT_EQ(weights.y(20, 18), usual);
    EXPECT_LT(weights.x(15, 10), 1e-5f);
    EXPECT_LT(weights.x(16, 11), 1e-4f); // means over squares lower the weights around an outlier
    EXPECT_LT(weights.y(4, 4), 1e-20f);
    EXPECT_FLOAT_EQ(weights.x(15, 14), usual);
    for (int y = 0; y < 20; ++y)
        EXPECT_EQ(weights.x(29, y), 0);
    for (int x = 0; x < 30; ++x)
        EXPECT_EQ(weights.y(x, 19), 0);
    images.patch = 4;
    EXPECT_FLOAT_EQ(weights_of_gradients(images, 0.2f).x(3, 17), 0.04f / (0.04f + k / 2 * 0.2f / 2));
}

/// A dark groove between bright boards, with noise in proportion to brightness. The groove must not take over the
/// noise of the boards, so variances are averaged relative to brightness, reconstruction (40).
TEST(EdgeWeights, AreSmallAtADarkGroove) {
    constexpr int groove = 10;
    const auto light = [](int y) { return y == groove ? 0.03f : 1.0f; };
    const auto variance = [&](int y) { return 0.04f * light(y) * light(y); };
    GradientImages images{RgbImage(30, 20), RgbImage(30, 20), RgbImage(30, 20), {}};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(30, 20);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) {
            images.primal(x, y) = Rgb(light(y));
            images.primal_variance(x, y) = variance(y);
            if (x < 29)
                images.dx_variance(x, y) = 0.1f * variance(y);
            if (y < 19)
                images.dy_variance(x, y) = 0.1f * (variance(y) + variance(y + 1));
        }
    for (const int y : {groove - 1, groove})
        for (int x = 0; x < 30; ++x)
            images.dy_variance(x, y) = std::max(variance(y), variance(y + 1));
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    EXPECT_LT(weights.y(15, groove - 1), 0.015f);
    EXPECT_LT(weights.y(15, groove), 0.015f);
    EXPECT_GT(weights.x(15, groove), 0.25f);
    EXPECT_GT(weights.x(15, 3), 0.25f);
}

TEST(EdgeWeights, AreBetweenZeroAndOneForAnyBrightness) {
    for (const float spot : {1e-30f, 1.0f, 1e12f, 1e17f, 1e30f})
        for (const bool is_measured : {false, true}) {
            GradientImages images{RgbImage(40, 30), RgbImage(40, 30), RgbImage(40, 30), {}};
            images.primal(20, 15) = Rgb(spot);
            if (is_measured)
                images.primal_variance = images.dx_variance = images.dy_variance =
                    Image<float>(40, 30, std::numeric_limits<float>::max());
            const EdgeWeights weights = weights_of_gradients(images, 0.2f);
            for (const Image<float>* edges : {&weights.x, &weights.y})
                for (const float w : *edges)
                    EXPECT_TRUE(w >= 0 && w <= 1) << spot;
        }
}

/// The variance on the right is a hundredth of that on the left.
TEST(EdgeWeights, FollowTheSmallerVarianceOfTheTwoPixels) {
    constexpr int width = 30, height = 20, border = 15;
    GradientImages images{RgbImage(width, height), RgbImage(width, height), RgbImage(width, height), {}};
    images.primal_variance = Image<float>(width, height, 2);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.2f);
    for (int y = 0; y < height; ++y)
        for (int x = border; x < width; ++x)
            images.primal_variance(x, y) = 0.02f;
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    EXPECT_LT(weights.x(border + 5, 10), 0.1f * weights.x(border - 6, 10));
    EXPECT_LT(weights.x(border - 1, 10), weights.x(border - 2, 10)); // means over squares blend the two
    for (int x = border - 4; x < border + 4; ++x)
        EXPECT_LE(weights.x(x, 10), weights.x(x - 1, 10)) << x;
    const EdgeWeights by_threads = weights_of_gradients(images, 0.2f, {}, backwards_for);
    EXPECT_TRUE(std::equal(by_threads.x.begin(), by_threads.x.end(), weights.x.begin()));
}

TEST(EdgeWeights, AreOneWithoutNoise) {
    GradientImages images{RgbImage(8, 8), RgbImage(8, 8), RgbImage(8, 8), {}};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(8, 8, 0);
    EXPECT_EQ(weights_of_gradients(images, 0.2f).x(3, 3), 1);
    images.dx_variance(3, 3) = 1; // the primal has no noise, so it needs no gradient
    EXPECT_EQ(weights_of_gradients(images, 0.2f).x(3, 3), 0);
}

} // namespace
} // namespace tessera
