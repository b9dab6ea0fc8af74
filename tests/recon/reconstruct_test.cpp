#include "recon/poisson_l1.h"
#include "recon/reconstruct.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

/// Steps and ramps with noise, and gradients with less noise but some outliers.
GradientImages noisy_images(int width, int height, float scale = 1) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
    GradientImages images{truth, x_differences(truth), y_differences(truth), {}};
    const RgbImage noise = random_image(width, height, 3);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rgb n = noise.data()[i];
        images.primal.data()[i] += 0.1f * n;
        images.dx.data()[i] += 0.02f * Rgb(n.y, n.z, n.x) + Rgb(i % 97 == 0 ? 1.0f : 0.0f);
        images.dy.data()[i] += 0.02f * Rgb(n.z, n.x, n.y);
    }
    for (RgbImage* image : {&images.primal, &images.dx, &images.dy})
        for (Rgb& c : *image)
            c *= scale;
    return images;
}

double l1_objective(const GradientImages& g, const RgbImage& image, float alpha) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const Rgb own = image(x, y);
            sum += alpha * glm::length(own - g.primal(x, y));
            if (x + 1 < image.width())
                sum += glm::length(image(x + 1, y) - own - g.dx(x, y));
            if (y + 1 < image.height())
                sum += glm::length(image(x, y + 1) - own - g.dy(x, y));
        }
    return sum;
}

TEST(Reconstruct, WithoutGradientsIsThePrimalPlusVeryDirectLight) {
    GradientImages images{RgbImage(5, 4, Rgb(1)), {}, {}, RgbImage(5, 4, Rgb(2))};
    for (const Norm norm : {Norm::none, Norm::l2, Norm::l1})
        EXPECT_EQ(reconstruct(images, {norm, 0.2f}).image(3, 2), Rgb(3));
    images.very_direct = {};
    EXPECT_EQ(reconstruct(images, {}).image(3, 2), Rgb(1));
}

TEST(Reconstruct, VeryDirectLightIsAddedAfterTheSolve) {
    GradientImages images = noisy_images(40, 30);
    for (const Norm norm : {Norm::l2, Norm::l1}) {
        images.very_direct = {};
        const RgbImage without = reconstruct(images, {norm, 0.2f}).image;
        images.very_direct = RgbImage(40, 30);
        images.very_direct(7, 9) = Rgb(100);
        const RgbImage with = reconstruct(images, {norm, 0.2f}).image;
        EXPECT_EQ(with(7, 9), without(7, 9) + Rgb(100));
        EXPECT_EQ(with(8, 9), without(8, 9));
    }
}

TEST(Reconstruct, ExactGradientsGiveTheImageBack) {
    const RgbImage image = random_image(37, 23, 9, 2, 0.5f);
    const GradientImages images{image, x_differences(image), y_differences(image), {}};
    for (const Norm norm : {Norm::none, Norm::l2, Norm::l1}) {
        const Reconstruction result = reconstruct(images, {norm, 0.2f});
        EXPECT_LE(relative_difference(result.image, image), 1e-5) << to_string(norm);
    }
}

TEST(Reconstruct, L2TellsItsResidual) {
    const Reconstruction result = reconstruct(noisy_images(61, 33), {Norm::l2, 0.2f});
    EXPECT_EQ(result.iterations, 1);
    EXPECT_GT(result.residual, 0);
    EXPECT_LT(result.residual, 1e-6);
}

TEST(Reconstruct, L1ComesNearItsOptimumAndBeatsL2There) {
    const GradientImages images = noisy_images(80, 60);
    const PoissonProblem problem{images.primal, images.dx, images.dy, 0.2f};
    PoissonSolver solver(80, 60);
    RgbImage longest;
    solve_poisson_l1(problem, solver, longest, serial_for, {}, 1500);
    const double optimum = l1_objective(images, longest, 0.2f);
    EXPECT_LT(l1_objective(images, reconstruct(images, {Norm::l1, 0.2f}).image, 0.2f), 1.01 * optimum);
    EXPECT_GT(l1_objective(images, reconstruct(images, {Norm::l2, 0.2f}).image, 0.2f), 1.05 * optimum);
}

TEST(Reconstruct, TheUnitOfRadianceDoesNotMatter) {
    const GradientImages images = noisy_images(50, 41);
    for (const Norm norm : {Norm::l2, Norm::l1}) {
        const RgbImage expected = reconstruct(images, {norm, 0.2f}).image;
        for (const float scale : {1e-4f, 1e4f}) {
            RgbImage image = reconstruct(noisy_images(50, 41, scale), {norm, 0.2f}).image;
            for (Rgb& c : image)
                c /= scale;
            EXPECT_LE(relative_difference(image, expected), 1e-4) << to_string(norm) << " " << scale;
        }
    }
}

TEST(Reconstruct, OddInputsGiveFiniteImages) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 30}, {30, 1}, {23, 19}}) {
        GradientImages images{RgbImage(width, height), RgbImage(width, height), RgbImage(width, height), {}};
        for (const float spike : {0.0f, 1e6f}) {
            images.primal(width / 2, height / 2) = Rgb(spike);
            images.dx(0, 0) = Rgb(-spike);
            for (const Norm norm : {Norm::l2, Norm::l1})
                EXPECT_TRUE(std::isfinite(largest(reconstruct(images, {norm, 0.2f}).image)));
        }
    }
}

TEST(Reconstruct, L1LeavesSpikesOut) {
    const RgbImage zero(60, 40);
    GradientImages images{RgbImage(60, 40, Rgb(1)), zero, zero, {}};
    images.primal(30, 20) = Rgb(3);
    images.dx(10, 10) = Rgb(3);
    const RgbImage truth(60, 40, Rgb(1));
    EXPECT_LE(relative_difference(reconstruct(images, {Norm::l1, 0.2f}).image, truth), 0.15);
    EXPECT_GE(relative_difference(reconstruct(images, {Norm::l2, 0.2f}).image, truth), 0.6);
}

TEST(Reconstruct, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    const GradientImages images = noisy_images(20, 20);
    for (const Norm norm : {Norm::l2, Norm::l1})
        EXPECT_TRUE(reconstruct(images, {norm, 0.2f}, serial_for, source.get_token()).image.empty());
}

TEST(Reconstruct, RefusesWhatMakesNoSense) {
    GradientImages images = noisy_images(20, 20);
    EXPECT_THROW(reconstruct(images, {Norm::l2, 0.0f}), std::invalid_argument);
    EXPECT_THROW(reconstruct(images, {Norm::l2, NAN}), std::invalid_argument);
    images.dx = RgbImage(20, 21);
    EXPECT_THROW(reconstruct(images, {Norm::l2, 0.2f}), std::invalid_argument);
}

} // namespace
} // namespace tessera
