// Uniform control variates, reconstruction (36).
#include "recon/picture/reconstruct.h"
#include "recon/solvers/poisson_direct.h"
#include "tests/recon/test_images.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

RgbImage average(const GradientImages& g, int iterations) {
    RgbImage image;
    EXPECT_EQ(average_neighbours({g.primal, g.dx, g.dy, 0.2f}, iterations, image), iterations);
    return image;
}

TEST(UniformControlVariates, TakesTheMeanOfFiveEstimates) {
    const GradientImages g = noisy_images(9, 7);
    const Rgb mean = (g.primal(4, 3) + g.primal(3, 3) + g.dx(3, 3) + g.primal(5, 3) - g.dx(4, 3) + g.primal(4, 2) +
                      g.dy(4, 2) + g.primal(4, 4) - g.dy(4, 3)) /
                     5.0f;
    const Rgb found = average(g, 1)(4, 3);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], mean[c], 1e-6);
}

/// The limit of many iterations is that of `l2` for alpha to 0.
TEST(UniformControlVariates, ConvergesToTheSolutionOfTheGradients) {
    const GradientImages g = noisy_images(17, 12);
    PoissonSolver solver(17, 12);
    RgbImage expected;
    solver.solve({g.primal, g.dx, g.dy, 0.001f}, expected);
    EXPECT_LE(relative_difference(average(g, 5000), expected), 1e-3);
}

TEST(UniformControlVariates, KeepsTheMeanOfThePrimal) {
    const GradientImages g = noisy_images(40, 30);
    const RgbImage image = average(g, 50);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_color(image)[c], mean_color(g.primal)[c], 1e-5);
    EXPECT_GT(relative_difference(image, g.primal), 0.1);
}

} // namespace
} // namespace tessera
