// Each pass renders every pixel once, for all tiles, patterns and image sizes. The scene is a wall of constant
// radiance, so an omitted pixel would be dark, and a repeated one twice as bright.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <cstdint>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int passes = 6; // each pass moves the tile grid

std::shared_ptr<const Scene> emitting_wall() {
    SceneBuilder b;
    b.quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, b.diffuse(Rgb(0.5f)), b.light(Rgb(0.5f, 1, 2)));
    b.camera({0, 0, 1}, {0, 0, 0}, 50);
    return b.build();
}

/// Returns settings of all methods, patterns and tile sizes.
std::vector<RenderSettings> all_tilings() {
    std::vector<RenderSettings> list;
    for (const Method method : all_methods)
        for (const Pattern pattern : {Pattern::tile, Pattern::rooks})
            for (const bool adapt : {false, true})
                for (const int tile : {1, 2, 3, 5, 6, 16}) {
                    RenderSettings s;
                    s.method = method;
                    s.pattern = pattern;
                    s.adapt_tile = adapt;
                    s.tile = tile;
                    s.max_depth = 2;
                    s.seed = static_cast<std::uint64_t>(tile);
                    list.push_back(s);
                }
    return list;
}

class Coverage : public testing::TestWithParam<glm::ivec2> {};

TEST_P(Coverage, EveryPixelHasOneSamplePerPass) {
    const auto scene = emitting_wall();
    const glm::ivec2 size = GetParam();
    ThreadPool pool(2);
    for (const RenderSettings& settings : all_tilings()) {
        Render render(scene, scene->camera(), size, settings);
        for (int pass = 0; pass < passes; ++pass)
            render.pass(pool);
        const GradientImages images = render.images();
        int wrong = 0;
        for (const Rgb c : images.very_direct)
            wrong += c != Rgb(0.5f, 1, 2);
        const std::string name = std::string(short_name(settings.method)) + " tile " +
                                 std::to_string(settings.tile) +
                                 (settings.pattern == Pattern::rooks ? " rooks" : "");
        EXPECT_EQ(wrong, 0) << name;
        // In PR, sampling sets do not overlap, so each base path is traced once and belongs to one set.
        const auto count = static_cast<std::uint64_t>(size.x * size.y * passes);
        if (settings.method == Method::pr) {
            EXPECT_EQ(render.counters().set_paths(), count) << name;
        }
        if (settings.method == Method::pr || settings.method == Method::pt) {
            EXPECT_EQ(render.counters().camera_paths, count) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(sizes, Coverage,
                         testing::Values(glm::ivec2(1, 1), glm::ivec2(1, 7), glm::ivec2(5, 3), glm::ivec2(16, 16),
                                         glm::ivec2(29, 41)),
                         [](const auto& p) {
                             return std::to_string(p.param.x) + "x" + std::to_string(p.param.y);
                         });

} // namespace

} // namespace tessera::test
