// Reconstruction of the components of a basis [Fang 2024].
#include "recon/picture/reconstruct.h"
#include "recon/solvers/component_solver.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

constexpr int width = 45, height = 34, components = 3;
constexpr float alpha = 0.2f;

/// Samples and their exact sum: smooth components with uneven projections, as under a normal map.
struct Truth {
    GradientImages images;
    RgbImage whole; ///< sum of components times projections, without noise
};

void add(RgbImage& image, const RgbImage& noise, float scale) {
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] += scale * noise.data()[i];
}

/// Returns such a truth. All images have noise, except the projections.
/// @param component_noise  of the gradients of components
Truth uneven_images(float primal_noise, float component_noise, unsigned seed = 1) {
    Truth t{{}, RgbImage(width, height)};
    for (int l = 0; l < components; ++l) {
        BasisComponent component{Image<float>(width, height), RgbImage(width, height), {}, {}};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto u = static_cast<float>(x) / width, v = static_cast<float>(y) / height;
                const auto phase = static_cast<float>((7 * x + 3 * y) % 5 + l);
                component.projection(x, y) = 0.58f * std::cos(phase);
                component.primal(x, y) = Rgb(1 + 0.3f * static_cast<float>(l) + u, 2 - v, 1 + u * v);
                t.whole(x, y) += component.projection(x, y) * component.primal(x, y);
            }
        component.dx = x_differences(component.primal);
        component.dy = y_differences(component.primal);
        const auto number = static_cast<std::uint32_t>(10 * seed + static_cast<unsigned>(l));
        add(component.dx, random_image(width, height, number), component_noise);
        add(component.dy, random_image(width, height, number + 100), component_noise);
        add(component.primal, random_image(width, height, number + 200), primal_noise);
        t.images.components.push_back(std::move(component));
    }
    t.images.primal = t.whole;
    add(t.images.primal, random_image(width, height, seed + 300), primal_noise);
    t.images.dx = x_differences(t.whole);
    t.images.dy = y_differences(t.whole);
    add(t.images.dx, random_image(width, height, seed + 400), primal_noise);
    add(t.images.dy, random_image(width, height, seed + 500), primal_noise);
    return t;
}

void set_variances(GradientImages& images, float primal_noise, float component_noise) {
    const Image<float> large(width, height, 3 * primal_noise * primal_noise),
        small(width, height, 3 * component_noise * component_noise);
    images.primal_variance = images.dx_variance = images.dy_variance = large;
    for (BasisComponent& component : images.components) {
        component.primal_variance = large;
        component.dx_variance = component.dy_variance = small;
    }
}

RgbImage solve(const GradientImages& images, Norm norm, const ParallelFor& parallel_for = serial_for) {
    ComponentSolver solver(width, height);
    RgbImage image;
    EXPECT_GT(solver.solve(images, norm, alpha, image, parallel_for), 0);
    return image;
}

double mean_square_difference(const RgbImage& a, const RgbImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d(a.data()[i] - b.data()[i]);
        sum += glm::dot(d, d);
    }
    return sum / static_cast<double>(a.size());
}

TEST(PoissonParts, OneComponentIsThePlainProblem) {
    GradientImages images = noisy_images(width, height);
    images.components.push_back({Image<float>(width, height, 1), images.primal, images.dx, images.dy});
    PoissonSolver plain(width, height);
    RgbImage expected;
    plain.solve(PoissonProblem{images.primal, images.dx, images.dy, alpha}, expected);
    EXPECT_LE(relative_difference(solve(images, Norm::l2), expected), 1e-4);
}

TEST(PoissonParts, ExactGradientsAndPrimalGiveTheTruth) {
    const Truth t = uneven_images(0, 0);
    for (const Norm norm : {Norm::l2, Norm::l1, Norm::mixed, Norm::weighted})
        EXPECT_LE(relative_difference(solve(t.images, norm), t.whole), 1e-4) << to_string(norm);
}

/// The gradients of smooth components reconstruct a whole whose own gradients are as noisy as its primal.
TEST(PoissonParts, SmoothComponentsReduceTheNoiseOfAnUnevenWhole) {
    Truth t = uneven_images(0.3f, 0.01f);
    set_variances(t.images, 0.3f, 0.01f);
    GradientImages plain = t.images;
    plain.components.clear();
    for (const Norm norm : {Norm::l2, Norm::mixed, Norm::weighted}) {
        const ReconstructionSettings settings{.norm = norm, .alpha = alpha};
        EXPECT_LT(mean_square_difference(reconstruct(t.images, settings).image, t.whole),
                  0.7 * mean_square_difference(reconstruct(plain, settings).image, t.whole))
            << to_string(norm);
    }
}

/// The picture of a sum is the sum of the pictures, so `l2` is unbiased.
TEST(PoissonParts, L2IsLinear) {
    const Truth a = uneven_images(0.3f, 0.2f, 1), b = uneven_images(0.5f, 0.1f, 2);
    GradientImages sum = a.images;
    const auto add_to = [](RgbImage& to, const RgbImage& from) { add(to, from, 1); };
    add_to(sum.primal, b.images.primal);
    for (std::size_t l = 0; l < components; ++l) {
        add_to(sum.components[l].primal, b.images.components[l].primal);
        add_to(sum.components[l].dx, b.images.components[l].dx);
        add_to(sum.components[l].dy, b.images.components[l].dy);
    }
    RgbImage expected = solve(a.images, Norm::l2);
    add_to(expected, solve(b.images, Norm::l2));
    EXPECT_LE(relative_difference(solve(sum, Norm::l2), expected), 1e-3);
}

TEST(PoissonParts, OutliersOfGradientsVanishInL1AndMixed) {
    Truth t = uneven_images(0.05f, 0.01f);
    for (int i = 0; i < 20; ++i)
        t.images.components[static_cast<std::size_t>(i % components)].dx((37 * i) % (width - 1),
                                                                         (11 * i) % height) += Rgb(30);
    const double l2 = mean_square_difference(solve(t.images, Norm::l2), t.whole);
    EXPECT_LT(mean_square_difference(solve(t.images, Norm::mixed), t.whole), 0.05 * l2);
    EXPECT_LT(mean_square_difference(solve(t.images, Norm::l1), t.whole), 0.05 * l2);
}

TEST(PoissonParts, GivesTheSameBitsInAnyOrder) {
    Truth t = uneven_images(0.3f, 0.1f);
    set_variances(t.images, 0.3f, 0.1f);
    for (const Norm norm : {Norm::l2, Norm::mixed, Norm::weighted})
        EXPECT_EQ(relative_difference(solve(t.images, norm, backwards_for), solve(t.images, norm)), 0);
}

TEST(PoissonParts, StopsBetweenSteps) {
    std::stop_source stop;
    stop.request_stop();
    ComponentSolver solver(width, height);
    RgbImage image;
    EXPECT_EQ(solver.solve(uneven_images(0.1f, 0.1f).images, Norm::l2, alpha, image, serial_for,
                           SolveWatch(stop.get_token())),
              0);
    EXPECT_TRUE(
        reconstruct(uneven_images(0.1f, 0.1f).images, {}, serial_for, SolveWatch(stop.get_token())).image.empty());
}

TEST(PoissonParts, OverflowGivesNoNaN) {
    Truth t = uneven_images(0.1f, 0.1f);
    t.images.components[0].dx(5, 5) = Rgb(1e30f);
    for (const Rgb& pixel : solve(t.images, Norm::l2))
        ASSERT_TRUE(is_finite(pixel));
}

} // namespace
} // namespace tessera
