// The multigrid preconditioner of `weighted`.
#include "recon/solvers/poisson_weighted.h"
#include "recon/solvers/weighted_multigrid.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

EdgeWeights weights_by(int width, int height, float (*weight)(int x, int y)) {
    EdgeWeights weights{Image<float>(width, height), Image<float>(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            weights.x(x, y) = x + 1 < width ? weight(x, y) : 0;
            weights.y(x, y) = y + 1 < height ? weight(x, y) : 0;
        }
    return weights;
}

// Constant weights, and weak patches with a strip of weight 0.
float constant(int, int) {
    return 1;
}
float patchy(int x, int y) {
    return x / 5 % 3 == 1 && y / 7 % 2 == 1 ? 1e-4f : x > 20 && x < 24 ? 0 : 0.5f;
}

double product(const RgbImage& a, const RgbImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += glm::dot(glm::dvec3(a.data()[i]), glm::dvec3(b.data()[i]));
    return sum;
}

constexpr std::pair<int, int> sizes[] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {37, 23}, {64, 48}, {67, 33}};

/// Conjugate gradients need such a preconditioner.
TEST(WeightedMultigrid, IsSymmetricAndPositive) {
    for (const auto weight : {constant, patchy})
        for (const auto& [width, height] : sizes)
            for (const float alpha : {0.02f, 0.2f, 2.0f}) {
                const EdgeWeights weights = weights_by(width, height, weight);
                WeightedMultigrid multigrid(width, height);
                multigrid.prepare(weights, alpha);
                const RgbImage a = random_image(width, height, 1), b = random_image(width, height, 2);
                RgbImage of_a(width, height), of_b(width, height);
                multigrid.apply(a, of_a);
                multigrid.apply(b, of_b);
                const double scale = std::sqrt(product(a, of_a) * product(b, of_b));
                EXPECT_GT(product(a, of_a), 0);
                EXPECT_NEAR(product(a, of_b), product(b, of_a), 1e-5 * scale) << width << "x" << height << alpha;
            }
}

/// Holds for all weights. Screening far weaker than the default needs more steps.
TEST(WeightedMultigrid, NeedsFewSteps) {
    constexpr int width = 300, height = 200;
    for (const auto weight : {constant, patchy})
        for (const float alpha : {0.02f, 0.08f, 0.5f}) {
            const GradientImages images = noisy_images(width, height);
            const PoissonProblem problem{images.primal, images.dx, images.dy, alpha};
            const EdgeWeights weights = weights_by(width, height, weight);
            const auto solved = [&](int steps) {
                RgbImage image;
                WeightedSolver(width, height).solve(problem, weights, {.cold_iterations = steps}, image);
                return image;
            };
            const RgbImage answer = solved(100);
            const double at_first = relative_rms_difference(images.primal, answer);
            EXPECT_LE(relative_rms_difference(solved(5), answer), (alpha < 0.05f ? 0.3 : 0.05) * at_first)
                << alpha;
        }
}

TEST(WeightedMultigrid, KeepsNothingOfAnEarlierPreparation) {
    const EdgeWeights first = weights_by(37, 23, patchy), second = weights_by(37, 23, constant);
    const RgbImage r = random_image(37, 23, 3);
    RgbImage before(37, 23), after(37, 23);
    WeightedMultigrid multigrid(37, 23), other(37, 23);
    multigrid.prepare(first, 0.3f);
    multigrid.apply(r, before);
    multigrid.prepare(second, 0.1f, backwards_for);
    multigrid.apply(r, after, backwards_for);
    other.prepare(second, 0.1f);
    other.apply(r, before);
    EXPECT_EQ(relative_difference(after, before), 0);
}

} // namespace
} // namespace tessera
