// The solver of `weighted`, reconstruction (37).
#include "recon/solvers/edge_weights.h"
#include "recon/solvers/poisson_weighted.h"
#include "tests/recon/sparse_solver.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <limits>
#include <stop_token>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

constexpr WeightedSettings exact{.cold_iterations = 300};

PoissonProblem problem_of(const GradientImages& images, float alpha = 0.2f) {
    return {images.primal, images.dx, images.dy, alpha};
}

RgbImage solve(const PoissonProblem& problem, const EdgeWeights& weights, const WeightedSettings& settings) {
    WeightedSolver solver(problem.primal.width(), problem.primal.height());
    RgbImage image;
    EXPECT_GT(solver.solve(problem, weights, settings, image), 0);
    return image;
}

/// Returns weights from 1 down to 1e-4, and some of 0.
EdgeWeights random_weights(int width, int height) {
    const RgbImage noise = random_image(width, height, 21);
    EdgeWeights weights{Image<float>(width, height), Image<float>(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgb n = noise(x, y);
            if (x + 1 < width)
                weights.x(x, y) = n.z > 2 ? 0 : std::exp(-3 * std::abs(n.x));
            if (y + 1 < height)
                weights.y(x, y) = n.z < -2 ? 0 : std::exp(-3 * std::abs(n.y));
        }
    return weights;
}

TEST(PoissonWeighted, EqualsASparseDirectSolve) {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {37, 23}, {64, 48}, {67, 33}, {128, 95}})
        for (const float alpha : {0.02f, 0.2f, 2.0f}) {
            const GradientImages images = noisy_images(width, height);
            const EdgeWeights weights = random_weights(width, height);
            const PoissonProblem problem = problem_of(images, alpha);
            EXPECT_LE(relative_difference(solve(problem, weights, exact), solve_sparse(problem, &weights)), 5e-5)
                << width << "x" << height << " " << alpha;
        }
}

TEST(PoissonWeighted, AFewStepsAreNearTheSolution) {
    const GradientImages images = noisy_images(160, 90);
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    const RgbImage expected = solve(problem_of(images), weights, exact);
    EXPECT_LE(relative_rms_difference(solve(problem_of(images), weights, {}), expected), 0.01);
}

TEST(PoissonWeighted, AWarmStartIsNearerToTheSolutionOfNewerData) {
    const GradientImages images = noisy_images(160, 90);
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    WeightedSolver solver(160, 90);
    RgbImage image;
    solver.solve(problem_of(images), weights, {}, image);
    GradientImages newer = images;
    const RgbImage noise = random_image(160, 90, 5, 0, 0.01f);
    for (std::size_t i = 0; i < noise.size(); ++i)
        newer.primal.data()[i] += noise.data()[i];
    const WeightedSettings two{.cold_iterations = 2, .warm_iterations = 2};
    solver.solve(problem_of(newer), weights, two, image);
    const RgbImage expected = solve(problem_of(newer), weights, exact),
                   cold = solve(problem_of(newer), weights, two);
    EXPECT_LE(relative_rms_difference(image, expected), 0.01);
    EXPECT_LE(relative_rms_difference(image, expected), 0.5 * relative_rms_difference(cold, expected));
    solver.forget();
    solver.solve(problem_of(newer), weights, two, image);
    EXPECT_EQ(relative_difference(image, cold), 0);
}

/// Snapshots of a render, each with more samples. The blobs of the first one must vanish.
TEST(PoissonWeighted, WarmStartsFollowTheirData) {
    for (const float alpha : {0.2f, 0.08f}) {
        WeightedSolver solver(120, 70);
        GradientImages images;
        RgbImage image;
        EdgeWeights weights;
        for (const float noise : {4.0f, 2.0f, 1.0f, 1.0f}) {
            images = noisy_images(120, 70);
            const RgbImage blobs = random_image(120, 70, static_cast<std::uint32_t>(100 * noise), 0, 0.1f);
            for (int y = 0; y < 70; ++y)
                for (int x = 0; x < 120; ++x)
                    images.primal(x, y) += (noise - 1) * (blobs(x / 20 * 20, y / 20 * 20) + Rgb(0.1f));
            weights = weights_of_gradients(images, alpha);
            solver.solve(problem_of(images, alpha), weights, {}, image);
            EXPECT_LE(glm::length(mean_color(image) - mean_color(images.primal)),
                      1e-4 * glm::length(mean_color(image)));
        }
        EXPECT_LE(relative_rms_difference(image, solve(problem_of(images, alpha), weights, exact)), 0.01) << alpha;
    }
}

TEST(PoissonWeighted, StartsColdAfterAStop) {
    const GradientImages images = noisy_images(60, 40);
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    WeightedSolver solver(60, 40);
    RgbImage image;
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(solver.solve(problem_of(images), weights, {}, image, serial_for, stop.get_token()), 0);
    solver.solve(problem_of(images), weights, {}, image);
    EXPECT_EQ(relative_difference(image, solve(problem_of(images), weights, {})), 0);
}

/// Squares of the values overflow. One width fills whole vectors, the other does not.
TEST(PoissonWeighted, KeepsNothingOfHugeValues) {
    for (const int width : {60, 67}) {
        const GradientImages images = noisy_images(width, 40);
        const EdgeWeights weights = weights_of_gradients(images, 0.2f);
        WeightedSolver solver(width, 40);
        RgbImage image;
        for (const float large : {1e25f, 3e38f}) {
            GradientImages huge = images;
            for (Rgb& c : huge.primal)
                c = Rgb(large);
            huge.dx(30, 20) = Rgb(large);
            solver.solve(problem_of(huge), weights, {}, image);
            solver.solve(problem_of(images), weights, {}, image);
            EXPECT_EQ(relative_difference(image, solve(problem_of(images), weights, {})), 0)
                << width << " " << large;
        }
    }
}

TEST(PoissonWeighted, StartsColdAfterABlackImage) {
    const GradientImages images = noisy_images(60, 40);
    const RgbImage zero(60, 40);
    const GradientImages black{zero, zero, zero, zero};
    const EdgeWeights weights = weights_of_gradients(images, 0.2f);
    WeightedSolver solver(60, 40);
    RgbImage image;
    solver.solve(problem_of(black), weights, {}, image);
    solver.solve(problem_of(images), weights, {}, image);
    EXPECT_EQ(relative_difference(image, solve(problem_of(images), weights, {})), 0);
}

/// One channel is black, and one very dark. Each channel has its own step lengths.
TEST(PoissonWeighted, ChannelsOfAnyBrightnessStayFinite) {
    for (const auto& [width, height] : {std::pair{3, 1}, {9, 1}, {30, 1}, {8, 8}})
        for (const float alpha : {1e-4f, 0.2f}) {
            GradientImages images = noisy_images(width, height);
            for (RgbImage* image : {&images.primal, &images.dx, &images.dy})
                for (Rgb& c : *image)
                    c *= Rgb(1, 0, 1e-6f);
            const RgbImage image = solve(problem_of(images, alpha), random_weights(width, height), exact);
            EXPECT_TRUE(std::isfinite(largest(image)));
            for (const Rgb c : image)
                EXPECT_LE(std::abs(c.b), 1e-4f);
        }
}

/// All columns of the matrix sum to alpha^2.
TEST(PoissonWeighted, KeepsTheMeanOfThePrimal) {
    const GradientImages images = noisy_images(120, 70);
    const RgbImage image = solve(problem_of(images), random_weights(120, 70), exact);
    EXPECT_LE(glm::length(mean_color(image) - mean_color(images.primal)), 1e-4 * glm::length(mean_color(image)));
}

TEST(PoissonWeighted, HasTheSameBitsWithThreads) {
    const GradientImages images = noisy_images(79, 61);
    const EdgeWeights weights = weights_of_gradients(images, 0.2f, {}, backwards_for);
    WeightedSolver solver(79, 61);
    RgbImage image;
    solver.solve(problem_of(images), weights, {}, image, backwards_for);
    EXPECT_EQ(relative_difference(image, solve(problem_of(images), weights_of_gradients(images, 0.2f), {})), 0);
}

} // namespace
} // namespace tessera
