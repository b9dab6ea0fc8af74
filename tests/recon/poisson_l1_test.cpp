// The solver of `l1` and `mixed`, reconstruction (34) and (35).
#include "recon/solvers/poisson_l1.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

constexpr float alpha = 0.2f;

PoissonProblem problem_of(const GradientImages& images) {
    return {images.primal, images.dx, images.dy, alpha};
}

L1Settings settings_of(bool square_primal, int cold_iterations) {
    return {.square_primal = square_primal, .cold_iterations = cold_iterations};
}

RgbImage solve_cold(const GradientImages& images, const L1Settings& settings) {
    L1Solver solver(images.primal.width(), images.primal.height());
    RgbImage image;
    solver.solve(problem_of(images), settings, image);
    return image;
}

/// Returns the sum that the solver minimises, in double precision.
double objective(const GradientImages& g, const RgbImage& image, const L1Settings& settings) {
    const auto norm = [](Rgb c) { return glm::length(glm::dvec3(c)); };
    const double typical = typical_value(g.primal);
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const Rgb own = image(x, y), misfit = own - g.primal(x, y);
            sum +=
                settings.square_primal ? alpha * alpha * glm::dot(misfit, misfit) / typical : alpha * norm(misfit);
            if (x + 1 < image.width())
                sum += norm(image(x + 1, y) - own - g.dx(x, y));
            if (y + 1 < image.height())
                sum += norm(image(x, y + 1) - own - g.dy(x, y));
        }
    return sum;
}

/// Returns a mean of a and a fraction of b, as further samples change a mean.
GradientImages blend(GradientImages a, const GradientImages& b, float fraction) {
    for (const auto image : {&GradientImages::primal, &GradientImages::dx, &GradientImages::dy})
        for (std::size_t i = 0; i < (a.*image).size(); ++i)
            (a.*image).data()[i] = (1 - fraction) * (a.*image).data()[i] + fraction * (b.*image).data()[i];
    return a;
}

double relative_mean_difference(const RgbImage& image, const RgbImage& expected) {
    return glm::length(mean_color(image) - mean_color(expected)) / glm::length(mean_color(expected));
}

TEST(PoissonL1, AColdStartIsNearTheOptimum) {
    const GradientImages images = noisy_images(160, 90);
    for (const bool square_primal : {false, true}) {
        const RgbImage optimum = solve_cold(images, settings_of(square_primal, 2000));
        const L1Settings settings{.square_primal = square_primal};
        const RgbImage image = solve_cold(images, settings);
        EXPECT_LE(settings.cold_iterations, 40);
        EXPECT_LE(objective(images, image, settings), 1.01 * objective(images, optimum, settings));
        EXPECT_LE(relative_mean_difference(image, optimum), 0.005);
    }
}

TEST(PoissonL1, AWarmStartIsNearTheOptimumOfNewerData) {
    const GradientImages images = noisy_images(160, 90);
    const GradientImages newer = blend(images, noisy_images(160, 90, 1, 17), 0.1f);
    for (const bool square_primal : {false, true}) {
        const L1Settings settings{.square_primal = square_primal};
        const RgbImage optimum = solve_cold(newer, settings_of(square_primal, 2000));
        L1Solver solver(160, 90);
        RgbImage image;
        EXPECT_EQ(solver.solve(problem_of(images), settings, image), settings.cold_iterations);
        EXPECT_EQ(solver.solve(problem_of(newer), settings, image), 5);
        EXPECT_LE(objective(newer, image, settings), 1.01 * objective(newer, optimum, settings));
        EXPECT_LE(relative_mean_difference(image, optimum), 0.005);
        solver.forget();
        EXPECT_EQ(solver.solve(problem_of(newer), settings, image), settings.cold_iterations);
        EXPECT_EQ(relative_difference(image, solve_cold(newer, settings)), 0);
    }
}

TEST(PoissonL1, MixedKeepsTheMeanOfThePrimal) {
    for (const std::uint32_t seed : {1, 2, 3}) {
        const GradientImages images = noisy_images(120, 70, 1, seed);
        const RgbImage image = solve_cold(images, {.square_primal = true});
        EXPECT_LE(relative_mean_difference(image, images.primal), 1e-4);
    }
}

TEST(PoissonL1, OutliersChangeNoOtherPixels) {
    const GradientImages images = noisy_images(80, 60);
    const RgbImage expected = solve_cold(images, {});
    GradientImages in_primal = images, in_dx = images, in_dy = images;
    in_primal.primal(40, 30) = Rgb(1e6f);
    in_dx.dx(20, 10) = Rgb(-1e6f, 1e6f, 0);
    in_dy.dy(60, 50) = Rgb(1e6f);
    for (const GradientImages* changed : {&in_primal, &in_dx, &in_dy}) {
        const RgbImage image = solve_cold(*changed, {});
        double sum = 0, expected_sum = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            sum += glm::length(image.data()[i] - expected.data()[i]);
            expected_sum += glm::length(expected.data()[i]);
        }
        EXPECT_LE(sum, 0.01 * expected_sum);
        EXPECT_LE(relative_difference(image, expected), 0.2); // the pixel of the outlier has less data
    }
    GradientImages in_gradients = in_dx;
    in_gradients.dy = in_dy.dy;
    EXPECT_LE(relative_difference(solve_cold(in_gradients, {.square_primal = true}),
                                  solve_cold(images, {.square_primal = true})),
              0.2);
}

TEST(PoissonL1, HasTheSameBitsWithThreads) {
    const GradientImages images = noisy_images(79, 61);
    L1Solver solver(79, 61);
    RgbImage image;
    solver.solve(problem_of(images), {}, image, backwards_for);
    EXPECT_EQ(relative_difference(image, solve_cold(images, {})), 0);
}

} // namespace
} // namespace tessera
