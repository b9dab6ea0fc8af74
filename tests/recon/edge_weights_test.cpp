// What gradients are to be trusted: weights by variances, brightness and pixels that look alike.
#include "recon/picture/edge_weights.h"
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
    GradientImages images{RgbImage(30, 20), RgbImage(30, 20), RgbImage(30, 20), {}};
    images.primal_variance = Image<float>(30, 20, 2);
    images.dx_variance = images.dy_variance = Image<float>(30, 20, 0.2f);
    for (int y = 0; y < 20; ++y)
        images.dx_variance(29, y) = 0; // nothing is measured there
    for (int x = 0; x < 30; ++x)
        images.dy_variance(x, 19) = 0;
    images.dx_variance(15, 10) = 1e6f;
    images.dy_variance(4, 4) = std::numeric_limits<float>::max();
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    constexpr float usual = 4 / 9.0f; // 0.04 / (0.04 + 0.2 / 2 / 2)
    EXPECT_FLOAT_EQ(weights.x(3, 17), usual);
    EXPECT_FLOAT_EQ(weights.y(28, 3), usual);
    EXPECT_FLOAT_EQ(weights.x(28, 17), usual);
    EXPECT_FLOAT_EQ(weights.y(20, 18), usual);
    EXPECT_LT(weights.x(15, 10), 1e-6f);
    EXPECT_LT(weights.x(16, 11), 1e-4f); // what is beside an outlier is not trusted, either
    EXPECT_LT(weights.y(4, 4), 1e-20f);
    EXPECT_FLOAT_EQ(weights.x(15, 14), usual);
    for (int y = 0; y < 20; ++y)
        EXPECT_EQ(weights.x(29, y), 0);
    for (int x = 0; x < 30; ++x)
        EXPECT_EQ(weights.y(x, 19), 0);
    images.patch = 4;
    EXPECT_FLOAT_EQ(weights_of_gradients(images, 0.2f).x(3, 17), 8 / 13.0f); // 0.04 / (0.04 + 0.2 / 2 / 2 / 2)
}

/// A dark groove between boards whose light is noisy, as much as they are bright: it knows how dark it is, and
/// takes nothing of their noise.
TEST(EdgeWeights, GroovesAreLeftAlone) {
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
    EXPECT_LT(weights.y(15, groove - 1), 0.015f); // 0.038 by variances that are blended as they are
    EXPECT_LT(weights.y(15, groove), 0.015f);
    EXPECT_GT(weights.x(15, groove), 0.25f);
    EXPECT_GT(weights.x(15, 3), 0.25f);
}

TEST(EdgeWeights, AreNumbersWhateverTheBrightness) {
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

/// A dark pixel whose spike is held back, and whose variance is not, beside a bright half: that this is far more
/// than so dark a pixel can have says nothing of bright pixels.
TEST(EdgeWeights, OfSpikesHeldBackCountAsFarAsTheyCan) {
    const auto weight_nearby = [](float spike) {
        GradientImages images{RgbImage(30, 20, Rgb(1)), RgbImage(30, 20), RgbImage(30, 20), {}};
        images.primal_variance = Image<float>(30, 20, 0.02f);
        images.dx_variance = images.dy_variance = Image<float>(30, 20, 0.004f);
        for (int y = 0; y < 20; ++y)
            for (int x = 15; x < 30; ++x) {
                images.primal(x, y) = Rgb(0.05f);
                images.primal_variance(x, y) = 5e-5f;
                images.dx_variance(x, y) = images.dy_variance(x, y) = 1e-5f;
            }
        images.primal_variance(15, 10) = spike;
        return weights_of_gradients(images, 0.2f).x(12, 10);
    };
    EXPECT_GT(weight_nearby(5e-5f), 0.2f);
    EXPECT_LT(weight_nearby(1e4f), 0.95f);
    EXPECT_EQ(weight_nearby(1e4f), weight_nearby(1e8f));
}

/// A dark board, a pixel wide and known well, between bright ones with noise: in squares of pixels most are of
/// these, but not of those that look alike.
TEST(EdgeWeights, PixelsThatLookAlikeTellHowWellOneIsKnown) {
    const int width = 30, height = 20, board = 15;
    GradientImages images{RgbImage(width, height, Rgb(1)), RgbImage(width, height), RgbImage(width, height), {}};
    images.primal_variance = Image<float>(width, height, 0.02f);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.004f);
    GuideImages guides{RgbImage(width, height, Rgb(0.8f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                       Image<float>(width, height, 1), Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y) {
        images.primal(board, y) = Rgb(0.05f);
        images.primal_variance(board, y) = 1e-6f;
        guides.albedo(board, y) = Rgb(0.02f);
    }
    const AlikePixels alike({width, height}, guides, serial_for);
    const EdgeWeights around = weights_of_gradients(images, 0.2f),
                      of_alike = weights_of_gradients(images, 0.2f, &alike);
    EXPECT_LT(of_alike.x(board, 10), 0.1f * around.x(board, 10));
    EXPECT_LT(of_alike.x(board - 1, 10), 0.1f * around.x(board - 1, 10));
    EXPECT_NEAR(of_alike.x(5, 10), around.x(5, 10), 0.01f * around.x(5, 10)); // amid what looks alike
    const EdgeWeights by_threads = weights_of_gradients(images, 0.2f, &alike, backwards_for);
    EXPECT_EQ(by_threads.x(board, 10), of_alike.x(board, 10));
}

/// Between two surfaces, of which one has a hundredth of the other's noise: what that one needs is what counts.
TEST(EdgeWeights, ThePixelThatIsKnownBetterDecides) {
    const int width = 30, height = 20, border = 15;
    GradientImages images{RgbImage(width, height), RgbImage(width, height), RgbImage(width, height), {}};
    images.primal_variance = Image<float>(width, height, 2);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.2f);
    GuideImages guides{RgbImage(width, height, Rgb(0.8f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                       Image<float>(width, height, 1), Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = border; x < width; ++x) {
            images.primal_variance(x, y) = 0.02f;
            guides.normal(x, y) = glm::vec3(1, 0, 0);
        }
    const AlikePixels alike({width, height}, guides, serial_for);
    const EdgeWeights weights = weights_of_gradients(images, 0.2f, &alike);
    EXPECT_NEAR(weights.x(border - 1, 10), weights.x(border + 5, 10), 0.01f * weights.x(border + 5, 10));
    EXPECT_GT(weights.x(border - 2, 10), 10 * weights.x(border - 1, 10));
}

TEST(EdgeWeights, WithoutNoiseAllGradientsAreTrusted) {
    GradientImages images{RgbImage(8, 8), RgbImage(8, 8), RgbImage(8, 8), {}};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(8, 8, 0);
    EXPECT_EQ(weights_of_gradients(images, 0.2f).x(3, 3), 1);
    images.dx_variance(3, 3) = 1; // of a primal without noise: the gradient is not needed
    EXPECT_EQ(weights_of_gradients(images, 0.2f).x(3, 3), 0);
}

} // namespace
} // namespace tessera
