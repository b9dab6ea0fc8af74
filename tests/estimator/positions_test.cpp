// Mixed pixels, and the camera positions from which a pass sees them. judge_test.cpp shows that they add no bias.
#include "render/estimator/pass.h"
#include "render/estimator/set_reuse.h"
#include "render/run/render.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(32, 24);

/// Returns a scene of a grey wall under a uniform sky, with a white pole in front that is thinner than a pixel.
std::shared_ptr<const Scene> pole_before_a_wall(float aperture_radius = 0) {
    SceneBuilder b;
    b.quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.diffuse(Rgb(0.1f)));
    b.quad({0.11f, -4, 0.5f}, {0.03f, 0, 0.01f}, {0, 8, 0}, b.diffuse(Rgb(0.9f)));
    b.environment(std::vector<Rgb>(8, Rgb(1)), 4);
    Camera camera{look_at({0, 0, 4}, {0, 0, 0}), 40, FovAxis::x};
    camera.aperture_radius = aperture_radius;
    camera.focus_distance = 4;
    b.camera(camera);
    return b.build();
}

RenderSettings settings_of(bool edge_rays, std::uint64_t seed = 0) {
    RenderSettings s;
    s.edge_rays = edge_rays;
    s.max_depth = 2;
    s.seed = seed;
    return s;
}

/// Returns 1 for the mixed pixels that a render finds before its first pass.
std::shared_ptr<const Image<std::uint8_t>> mixed_pixels(const std::shared_ptr<const Scene>& scene,
                                                        const RenderSettings& settings) {
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(1);
    render.pass(pool);
    return render.newest_learned()->mixed();
}

RgbImage picture(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings, int passes) {
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(1);
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    return render.images().demodulation.value;
}

/// Errors of pictures of one pass in all mixed pixels.
struct Errors {
    double squared = 0; ///< sum of squares
    double z = 0;       ///< bias of the mean over these pixels, in standard errors
};
Errors errors(const std::shared_ptr<const Scene>& scene, RenderSettings s, const RgbImage& truth,
              const Image<std::uint8_t>& mixed) {
    constexpr int renders = 64;
    double sum = 0, squares = 0;
    Errors result;
    for (int i = 1; i <= renders; ++i) {
        s.seed = static_cast<std::uint64_t>(i);
        const RgbImage image = picture(scene, s, 1);
        double error = 0;
        for (std::size_t p = 0; p < image.size(); ++p)
            if (mixed.data()[p]) {
                const double d = luminance(image.data()[p]) - luminance(truth.data()[p]);
                result.squared += d * d;
                error += d;
            }
        sum += error;
        squares += error * error;
    }
    result.z = sum / std::sqrt(squares);
    return result;
}

} // namespace

TEST(Positions, MixedPixelsAreThoseAtThePole) {
    const auto scene = pole_before_a_wall();
    const auto mixed = mixed_pixels(scene, settings_of(true));
    int count = 0;
    for (int x = 0; x < size.x; ++x)
        for (int y = 0; y < size.y; ++y)
            if ((*mixed)(x, y)) {
                EXPECT_NEAR(x, 17, 1.5) << y;
                ++count;
            }
    EXPECT_GE(count, 2 * size.y);
}

TEST(Positions, TurnsAreUniformAndDifferInARow) {
    for (const int count : {1, 2, 3, 4, 7, 8, 16}) {
        std::map<int, int> turns_of_a_pixel;
        for (int index = 0; index < 4000; ++index) {
            const PassNumbers numbers(3, index, 0, count);
            std::set<int> turns_of_a_row;
            for (int x = 0; x < count; ++x)
                turns_of_a_row.insert(numbers.turn({x, 5}));
            ASSERT_EQ(turns_of_a_row.size(), static_cast<std::size_t>(count));
            ++turns_of_a_pixel[numbers.turn({5, 7})];
        }
        for (int turn = 0; turn < count; ++turn) // at least 5 standard deviations
            EXPECT_NEAR(turns_of_a_pixel[turn], 4000.0 / count, 5 * 32) << count << " positions, " << turn;
    }
}

TEST(Positions, AreANetOverThePasses) {
    // 16 passes of 4 positions have one position in each of 64 columns and rows.
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        std::set<int> columns, rows;
        for (int index = 0; index < 16; ++index) {
            const PassNumbers numbers(seed, index, 0, 4);
            for (int i = 0; i < 4; ++i) {
                const glm::vec2 at = numbers.subpixel(9, 0, i);
                columns.insert(static_cast<int>(at.x * 64));
                rows.insert(static_cast<int>(at.y * 64));
            }
        }
        EXPECT_EQ(columns.size(), 64u);
        EXPECT_EQ(rows.size(), 64u);
    }
}

TEST(Positions, ReduceTheNoiseOfMixedPixels) {
    for (const Method method : {Method::pr, Method::gpr}) {
        const auto scene = pole_before_a_wall();
        RenderSettings s = settings_of(false);
        s.method = method;
        const auto mixed = mixed_pixels(scene, settings_of(true));
        const RgbImage truth = picture(scene, settings_of(true, 99), 1024);
        const Errors one = errors(scene, s, truth, *mixed);
        s.edge_rays = true;
        const Errors several = errors(scene, s, truth, *mixed);
        EXPECT_LT(1.25 * several.squared, one.squared);
        EXPECT_LT(std::abs(one.z), 4);
        EXPECT_LT(std::abs(several.z), 4);
    }
}

/// theory (20): the factors g make the counts of base paths equal, however many pixels of the set have their turn
/// at a position.
TEST(Positions, CountEqualNumbersOfBasePaths) {
    const auto scene = pole_before_a_wall();
    const RenderSettings s = settings_of(true);
    LearnedReuse learned(size, s);
    learned.set_mixed(std::make_shared<const Image<std::uint8_t>>(size.x, size.y, std::uint8_t{1}));
    const Pass pass(*scene, scene->camera(), size, s, learned, 0);
    Worker worker(*scene, scene->camera(), size, s, nullptr);
    worker.base.trace(pass, worker.tracer, {0, 0, 8, 8}, {0, 0});
    for (const int edge : {1, 2, 3, 5, 7}) {
        SamplingSet& set = worker.set;
        set.assign({1, 0, 1 + edge, edge});
        set.positions = edge_positions;
        std::map<int, float> counts; // of each position
        collect(pass, worker.base, set);
        for (int i = 0; i < set.size(); ++i)
            counts[pass.turn(set.pixels[static_cast<std::size_t>(i)])] += set.counts[static_cast<std::size_t>(i)];
        float sum = 0;
        for (const auto& [turn, count] : counts) {
            EXPECT_NEAR(count, static_cast<float>(set.size()) / static_cast<float>(counts.size()), 1e-4f) << edge;
            sum += count;
        }
        EXPECT_NEAR(sum, static_cast<float>(set.size()), 1e-3f);
    }
}

TEST(Positions, HaveTheirOwnLensPoints) {
    const auto scene = pole_before_a_wall(0.5f);
    const RenderSettings s = settings_of(true);
    const LearnedReuse learned(size, s);
    const Pass pass(*scene, scene->camera(), size, s, learned, 5);
    EXPECT_NE(pass.sample_at(0, {3, 3}, 0).lens.x, pass.sample_at(1, {3, 3}, 0).lens.x);
}

} // namespace tessera::test
