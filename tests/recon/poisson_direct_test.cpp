// The direct solver of `l2`, reconstruction (33), against a sparse solver.
#include "recon/solvers/poisson_direct.h"
#include "tests/recon/sparse_solver.h"
#include "tests/recon/test_images.h"

#include <cstring>
#include <limits>
#include <ostream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

struct Inputs {
    explicit Inputs(int width, int height, std::uint32_t seed = 1)
        : primal(random_image(width, height, seed, 1)), dx(random_image(width, height, seed + 1)),
          dy(random_image(width, height, seed + 2)) {}

    PoissonProblem problem(float alpha) const { return {primal, dx, dy, alpha}; }

    RgbImage primal, dx, dy;
};

RgbImage solve(const PoissonProblem& problem) {
    PoissonSolver solver(problem.primal.width(), problem.primal.height());
    RgbImage image;
    solver.solve(problem, image);
    return image;
}

struct Size {
    int width, height;
};

void PrintTo(const Size& size, std::ostream* out) {
    *out << size.width << "x" << size.height;
}

constexpr float alphas[] = {0.001f, 0.01f, 0.03f, 0.1f, 0.2f, 1, 10};

class PoissonSizes : public testing::TestWithParam<Size> {};

TEST_P(PoissonSizes, EqualsTheSparseSolve) {
    const auto [width, height] = GetParam();
    const Inputs inputs(width, height);
    for (const float alpha : alphas) {
        const PoissonProblem problem = inputs.problem(alpha);
        EXPECT_LE(relative_difference(solve(problem), solve_sparse(problem)), 1e-5) << "alpha " << alpha;
    }
}

TEST_P(PoissonSizes, SolvesProblemsWithOutliers) {
    const auto [width, height] = GetParam();
    for (const float alpha : {0.001f, 0.2f, 10.0f}) {
        Inputs inputs(width, height);
        inputs.primal(width / 2, height / 3) = Rgb(1e6f, 0, -1e6f);
        inputs.dx(0, height / 2) = Rgb(0, 1e6f, 0);
        const PoissonProblem problem = inputs.problem(alpha);
        EXPECT_LE(relative_difference(solve(problem), solve_sparse(problem)), 1e-5) << "alpha " << alpha;
    }
}

TEST_P(PoissonSizes, ReturnsTheImageOfExactGradients) {
    const auto [width, height] = GetParam();
    const RgbImage image = random_image(width, height, 5, 1);
    const RgbImage dx = x_differences(image), dy = y_differences(image);
    for (const float alpha : alphas)
        EXPECT_LE(relative_difference(solve({image, dx, dy, alpha}), image), 1e-5) << "alpha " << alpha;
}

TEST_P(PoissonSizes, KeepsTheMean) {
    const auto [width, height] = GetParam();
    const Inputs inputs(width, height);
    for (const float alpha : alphas) {
        const RgbImage image = solve(inputs.problem(alpha));
        const glm::dvec3 difference = mean_color(image) - mean_color(inputs.primal);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(difference[c], 0, 1e-5 * largest(image)) << "alpha " << alpha;
    }
}

INSTANTIATE_TEST_SUITE_P(All, PoissonSizes,
                         testing::Values(Size{1, 1}, Size{1, 2}, Size{2, 1}, Size{1, 97}, Size{97, 1}, Size{1, 64},
                                         Size{64, 1}, Size{7, 7}, Size{17, 3}, Size{3, 17}, Size{16, 16},
                                         Size{37, 23}, Size{31, 53}, Size{45, 33}, Size{65, 17}, Size{127, 95},
                                         Size{121, 67}, Size{128, 96}));

TEST(PoissonSolver, ConstantImageStaysConstant) {
    for (const int width : {60, 61}) {
        const RgbImage image(width, 40, Rgb(1000, 1, 0)), zero(width, 40);
        for (const float alpha : alphas)
            EXPECT_LE(relative_difference(solve({image, zero, zero, alpha}), image), 1e-6) << "alpha " << alpha;
    }
}

TEST(PoissonSolver, IgnoresGradientsAcrossTheBorder) {
    Inputs inputs(37, 23);
    const RgbImage expected = solve(inputs.problem(0.2f));
    for (int y = 0; y < 23; ++y)
        inputs.dx(36, y) = Rgb(NAN);
    for (int x = 0; x < 37; ++x)
        inputs.dy(x, 22) = Rgb(NAN);
    const RgbImage image = solve(inputs.problem(0.2f));
    EXPECT_EQ(std::memcmp(image.data(), expected.data(), image.size() * sizeof(Rgb)), 0);
}

TEST(PoissonSolver, SolvesManyProblemsOfItsSize) {
    PoissonSolver solver(61, 45);
    RgbImage image;
    for (const float alpha : {0.2f, 0.02f, 0.2f}) {
        const Inputs inputs(61, 45, 77);
        solver.solve(inputs.problem(alpha), image);
        EXPECT_LE(relative_difference(image, solve_sparse(inputs.problem(alpha))), 1e-5);
    }
}

/// Some of these widths do not fill whole vectors of the transforms.
TEST(PoissonSolver, KeepsNothingOfInvalidPixels) {
    for (int width = 60; width < 110; ++width) {
        const Inputs valid(width, 20);
        Inputs invalid = valid;
        invalid.primal(7, 5) = Rgb(std::numeric_limits<float>::infinity());
        PoissonSolver solver(width, 20);
        RgbImage image;
        solver.solve(invalid.problem(0.2f), image);
        solver.solve(valid.problem(0.2f), image);
        EXPECT_EQ(relative_difference(image, solve(valid.problem(0.2f))), 0) << width;
    }
}

TEST(PoissonSolver, HasTheSameBitsWithThreads) {
    for (const int width : {240, 241}) {
        const Inputs inputs(width, 101);
        for (const float alpha : {0.01f, 0.2f}) {
            PoissonSolver solver(width, 101);
            RgbImage alone, together;
            solver.solve(inputs.problem(alpha), alone);
            solver.solve(inputs.problem(alpha), together, backwards_for);
            EXPECT_EQ(std::memcmp(alone.data(), together.data(), alone.size() * sizeof(Rgb)), 0);
        }
    }
}

TEST(PoissonSolver, RejectsAnEmptyImage) {
    EXPECT_THROW(PoissonSolver(0, 5), std::invalid_argument);
    EXPECT_THROW(PoissonSolver(5, 0), std::invalid_argument);
}

TEST(PoissonResidual, IsSmallForTheSolutionOnly) {
    const Inputs inputs(64, 33);
    const PoissonProblem problem = inputs.problem(0.2f);
    EXPECT_LT(poisson_residual(problem, solve(problem)), 1e-6);
    EXPECT_GT(poisson_residual(problem, inputs.primal), 0.1);
    EXPECT_EQ(poisson_residual({RgbImage(4, 4), RgbImage(4, 4), RgbImage(4, 4), 0.2f}, RgbImage(4, 4)), 0);
}

} // namespace
} // namespace tessera
