// The unit of radiance does not matter. With all lights 1024 times as bright, the same paths are traced, shifted
// and kept, and the image is exactly 1024 times as bright, because scaling floats by powers of two is exact.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(25, 19);
constexpr int passes = 8; // tile splitting uses the results of earlier passes

/// Returns a room with all kinds of lights, and materials with and without half vectors.
std::shared_ptr<const Scene> room(float scale) {
    OpenRoom r;
    std::vector<Rgb> sky;
    for (int i = 0; i < 24; ++i)
        sky.push_back(scale * Rgb(0.1f + 0.05f * float(i % 5), 0.2f, 0.3f + 0.1f * float(i / 8)));
    r.environment(sky, 8);
    r.sun({glm::normalize(glm::vec3(1, 2, 1)), 0.3f, scale * Rgb(6, 5, 4)});
    r.point({{-0.4f, 0.5f, 0.3f}, scale * Rgb(0.5f, 0.8f, 0.6f)});
    r.directional({glm::normalize(glm::vec3(0.4f, 1, 0.7f)), scale * Rgb(0.3f, 0.4f, 0.9f)});
    r.quad({-0.8f, 0.9f, 0}, {0.4f, 0, 0}, {0, 0, 0.4f}, r.w, r.light(scale * Rgb(20, 10, 30)));
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.08f));
    r.sphere({-0.5f, -0.6f, 0.2f}, 0.3f, r.glass());
    return r.build();
}

struct Result {
    GradientImages images;
    Counters counters;
};

Result render(const RenderSettings& settings, float scale) {
    const auto scene = room(scale);
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(2);
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    return {render.images(), render.counters()};
}

int unequal(const RgbImage& a, const RgbImage& b, float scale) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a.data()[i] * scale != b.data()[i];
    return count;
}

class LightUnit : public testing::TestWithParam<Method> {};

TEST_P(LightUnit, ScalesTheImageExactly) {
    RenderSettings settings;
    settings.method = GetParam();
    settings.max_depth = 5;
    settings.shift_threshold = 0.1f;
    const Result one = render(settings, 1);
    for (const float scale : {0x1p-10f, 0x1p10f}) {
        const Result other = render(settings, scale);
        EXPECT_EQ(unequal(one.images.primal, other.images.primal, scale), 0);
        EXPECT_EQ(unequal(one.images.dx, other.images.dx, scale), 0);
        EXPECT_EQ(unequal(one.images.dy, other.images.dy, scale), 0);
        EXPECT_EQ(unequal(one.images.very_direct, other.images.very_direct, scale), 0);
        EXPECT_EQ(one.counters.rays, other.counters.rays);
        EXPECT_EQ(one.counters.shifts, other.counters.shifts);
        EXPECT_EQ(one.counters.dark_paths, other.counters.dark_paths);
        EXPECT_EQ(one.counters.skipped_paths, other.counters.skipped_paths);
        EXPECT_EQ(one.counters.reused_paths, other.counters.reused_paths);
    }
    if (reuses_paths(GetParam())) {
        EXPECT_GT(one.counters.skipped_paths, 100u); // the test needs Russian roulette to reject paths
    }
}

INSTANTIATE_TEST_SUITE_P(methods, LightUnit, testing::ValuesIn(all_methods),
                         [](const auto& p) { return std::string(short_name(p.param)); });

} // namespace

} // namespace tessera::test
