// Reconstruction filters: filter importance sampling, and pictures of a known image against its convolution.
#include "render/sampling/pixel_filter.h"
#include "render/scene/camera.h"
#include "tests/support/scene_builder.h"
#include "tests/support/z_scores.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr FilterKind kinds[] = {FilterKind::box,      FilterKind::tent,       FilterKind::gaussian,
                                FilterKind::mitchell, FilterKind::catmullrom, FilterKind::lanczos};

/// Returns the mean of a function of one coordinate under a filter around 0, by the midpoint rule.
template <class Function>
double convolved(const PixelFilter& filter, const Function& f) {
    constexpr int steps = 40000;
    double sum = 0, weights = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = filter.radius * (2 * (i + 0.5) / steps - 1), weight = filter.value(static_cast<float>(x));
        sum += weight * f(x);
        weights += weight;
    }
    return sum / weights;
}

TEST(PixelFilter, SamplesFollowTheFilter) {
    for (const FilterKind kind : kinds) {
        const PixelFilter filter = default_filter(kind);
        const FilterSampler sampler(filter);
        const auto f = [](double x) { return std::cos(1.3 * x) + 0.2 * x; };
        const auto g = [](double y) { return y * y; };
        constexpr int n = 2048;
        double sum = 0, weights = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto point = sampler.sample({(i + 0.5f) / n, (j + 0.5f) / n});
                sum += point.weight * f(point.subpixel.x - 0.5) * g(point.subpixel.y - 0.5);
                weights += point.weight;
            }
        // A row of points can lie on the wrong side of a change of sign, which is an error of about 2 / n.
        const double expected = convolved(filter, f) * convolved(filter, g);
        EXPECT_NEAR(sum / (n * n), expected, 5e-3) << to_string(kind);
        EXPECT_NEAR(weights / (n * n), 1, 4e-3) << to_string(kind);
    }
}

TEST(PixelFilter, TheBoxKeepsTheNumbers) {
    const auto point = FilterSampler(PixelFilter()).sample({0.3f, 0.9f});
    EXPECT_EQ(point.subpixel, glm::vec2(0.3f, 0.9f));
    EXPECT_EQ(point.weight, 1);
}

TEST(PixelFilter, OnlyFiltersWithNegativeLobesHaveOtherWeights) {
    for (const FilterKind kind : kinds) {
        const FilterSampler sampler(default_filter(kind));
        const bool has_lobes = kind > FilterKind::gaussian;
        EXPECT_EQ(sampler.sample({0.5f, 0.5f}).weight == 1, !has_lobes) << to_string(kind);
        EXPECT_EQ(sampler.sample({0.01f, 0.5f}).weight < 0, has_lobes && kind != FilterKind::lanczos)
            << to_string(kind); // the outermost lobe of Lanczos is positive
    }
}

/// A wall whose radiance is the product of a step in x and a step in y, at places within pixels.
struct Wall {
    static constexpr glm::ivec2 size{14, 10};
    static constexpr float edge_x = 0.27f, edge_y = -0.11f; ///< in the picture's half widths, to the right and up
    static constexpr float left = 0.8f, right = 0.3f, above = 1, below = 0.25f;
    static constexpr float irradiance = 5;

    /// @param emits  whether the wall emits its radiance, or reflects a distant light
    static std::shared_ptr<const Scene> scene(bool emits) {
        SceneBuilder b;
        const auto part = [&](glm::vec2 low, glm::vec2 high, float reflectance) {
            const float radiance = reflectance * irradiance / std::numbers::pi_v<float>;
            b.quad({low.x, low.y, 0}, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0},
                   b.diffuse(Rgb(emits ? 0 : reflectance)), emits ? b.light(Texture{Rgb(radiance)}) : -1);
        };
        part({-9, edge_y}, {edge_x, 9}, left * above);
        part({edge_x, edge_y}, {9, 9}, right * above);
        part({-9, -9}, {edge_x, edge_y}, left * below);
        part({edge_x, -9}, {9, edge_y}, right * below);
        if (!emits)
            b.directional({{0, 0, 1}, Rgb(irradiance)});
        Camera camera{look_at({0, 0, 4}, {0, 0, 0})};
        camera.is_orthographic = true;
        b.camera(camera);
        return b.build();
    }

    static RgbImage expected(const PixelFilter& filter) {
        const double pixels = size.x / 2.0; // per unit
        RgbImage image(size.x, size.y);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const double across = convolved(
                    filter, [&](double d) { return x + 0.5 + d < size.x / 2.0 + edge_x * pixels ? left : right; });
                const double down = convolved(filter, [&](double d) {
                    return y + 0.5 + d < size.y / 2.0 - edge_y * pixels ? above : below;
                });
                image(x, y) = Rgb(static_cast<float>(across * down * irradiance / std::numbers::pi));
            }
        return image;
    }
};

constexpr int runs = 24, passes = 32;

/// Returns the measurement with a least standard error: edges that the tail of a filter reaches in no run are
/// unknown to about the reciprocal of the number of samples.
Measured floored(Measured m) {
    constexpr float least = 2 * Wall::irradiance / (runs * passes);
    for (Rgb& error : m.standard_error)
        error = glm::max(error, Rgb(least / std::sqrt(static_cast<float>(runs))));
    return m;
}

/// Returns whether a z-test passes. Pixels that reuse paths share the sign of a filter's lobe, so their errors are
/// correlated over the whole picture, and only the largest z counts.
bool agrees(const ZResult& z, FilterKind kind, Method method) {
    const bool is_common = kind > FilterKind::gaussian && method != Method::pt;
    return is_common ? z.largest < z.limit : z.passes();
}

Measured exact(const RgbImage& image) {
    return {image, RgbImage(image.width(), image.height())};
}

void expect_convolution(FilterKind kind, Method method, Basis basis) {
    RenderSettings s;
    s.filter = kind;
    s.method = method;
    s.basis = basis;
    s.max_depth = 2;
    s.seed = 100;
    const std::string name = std::string(to_string(kind)) + " " + std::string(short_name(method)) +
                             (basis == Basis::none ? "" : " albedo");
    const Measured truth = exact(Wall::expected(default_filter(kind)));
    const MethodMeasured m = measure(Wall::scene(false), Wall::size, s, runs, passes, {});
    const ZResult primal = z_test(floored(m.primal), truth);
    EXPECT_TRUE(agrees(primal, kind, method)) << name << ": " << primal.to_string();
    if (!has_gradients(method) || basis != Basis::none)
        return;
    for (const auto& [found, wanted] :
         {std::pair(m.dx, difference_x(truth)), std::pair(m.dy, difference_y(truth))}) {
        const ZResult gradient = z_test(floored(found), wanted);
        EXPECT_TRUE(agrees(gradient, kind, method)) << name << " gradient: " << gradient.to_string();
    }
}

TEST(PixelFilter, PicturesAreConvolutionsOfTheImage) {
    for (const FilterKind kind : kinds)
        for (const Method method : {Method::pt, Method::gpr})
            expect_convolution(kind, method, Basis::none);
    for (const Method method : {Method::pr, Method::gpt, Method::gpr})
        expect_convolution(FilterKind::mitchell, method, Basis::albedo);
}

TEST(PixelFilter, TheTestRejectsAnotherFilter) {
    RenderSettings s;
    s.filter = FilterKind::mitchell;
    s.max_depth = 2;
    const MethodMeasured m = measure(Wall::scene(false), Wall::size, s, runs, passes, {});
    EXPECT_FALSE(z_test(floored(m.primal), exact(Wall::expected(default_filter(FilterKind::gaussian)))).passes());
}

TEST(PixelFilter, DirectlyVisibleEmissionIsFiltered) {
    for (const FilterKind kind : kinds) {
        RenderSettings s;
        s.filter = kind;
        s.max_depth = 1;
        const MethodMeasured m = measure(Wall::scene(true), Wall::size, s, runs, passes, {});
        const ZResult z = z_test(floored(m.very_direct), exact(Wall::expected(default_filter(kind))));
        EXPECT_TRUE(agrees(z, kind, s.method)) << to_string(kind) << ": " << z.to_string();
    }
}

TEST(PixelFilter, TheSceneHasAFilterOfItsOwn) {
    SceneDescription description = Wall::scene(false)->description();
    description.camera.filter = gaussian_filter(0.8f);
    const auto scene = std::make_shared<const Scene>(description);
    RenderSettings s;
    s.filter = FilterKind::scene;
    s.max_depth = 2;
    const ZResult z = z_test(floored(measure(scene, Wall::size, s, runs, passes, {}).primal),
                             exact(Wall::expected(gaussian_filter(0.8f))));
    EXPECT_TRUE(z.passes()) << z.to_string();
}

} // namespace

} // namespace tessera::test
