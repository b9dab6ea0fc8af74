#include "render/run/first_hits.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// Returns a scene with a diffuse wall three units ahead, and a light behind the camera.
std::shared_ptr<const Scene> wall() {
    SceneBuilder scene;
    const int grey = scene.diffuse({0.6f, 0.3f, 0.1f});
    scene.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
    scene.quad({-1, -1, 9}, {0, 2, 0}, {2, 0, 0}, grey, scene.light(Rgb(5)));
    scene.camera({0, 0, 3}, {0, 0, 0}, 60);
    return scene.build();
}

TEST(FirstHits, MatchAWall) {
    const auto scene = wall();
    const glm::ivec2 size(33, 33);
    const FirstHits hits = trace_first_hits(*scene, scene->camera(), size);
    EXPECT_NEAR(hits.depth(16, 16), 3, 1e-4f);
    EXPECT_NEAR(hits.normal(16, 16).z, 1, 1e-5f);
    EXPECT_LT(glm::distance(hits.albedo(16, 16), Rgb(0.6f, 0.3f, 0.1f)), 1e-4f);
    // A field of view of 60 degrees spans 1.73 units to each side at a distance of 3, so the corner ray misses the
    // wall.
    EXPECT_EQ(hits.depth(0, 0), 0);
    EXPECT_EQ(hits.normal(0, 0), Rgb(0));
    const float slanted = hits.depth(10, 16);
    EXPECT_GT(slanted, 3.001f);
    EXPECT_NEAR(slanted, std::hypot(3.0f, 3 * 6 * 2 * std::tan(glm::radians(30.0f)) / 33), 1e-3f);
}

/// The scene has a diffuse wall and a mirror ahead, and a wall behind the camera. First footprints are one pixel
/// wide. Second footprints follow the pixel's cone after the mirror, and are wide after diffuse scattering.
TEST(FirstHits, FootprintsAreWideAfterDiffuseScattering) {
    SceneBuilder scene;
    const int grey = scene.diffuse(Rgb(0.5f));
    scene.quad({-3, -3, 0}, {3, 0, 0}, {0, 6, 0}, grey);
    scene.quad({0, -3, 0}, {3, 0, 0}, {0, 6, 0}, scene.conductor(0));
    scene.quad({-30, -30, 9}, {0, 60, 0}, {60, 0, 0}, grey);
    scene.quad({-1, 20, 0}, {2, 0, 0}, {0, 0, 2}, grey, scene.light(Rgb(5)));
    scene.camera({0, 0, 3}, {0, 0, 0}, 60);
    const auto built = scene.build();
    const glm::ivec2 size(32, 32);
    EXPECT_TRUE(trace_first_hits(*built, built->camera(), size).footprint_1.empty());
    const FirstHits hits = trace_first_hits(*built, built->camera(), size, true);
    const float pixel = 2 * std::tan(glm::radians(30.0f)) / 32; // width of a pixel at a distance of one unit
    EXPECT_NEAR(hits.footprint_1(14, 15), 3 * pixel, 0.02f * pixel);
    EXPECT_NEAR(hits.footprint_1(17, 15), 3 * pixel, 0.02f * pixel);
    EXPECT_NEAR(hits.footprint_2(17, 15), 12 * pixel, 0.1f * pixel);
    int wide = 0;
    for (int y = 8; y < 24; ++y)
        wide += hits.footprint_2(14, y) > 3;
    EXPECT_GT(wide, 12);
}

TEST(FirstHits, StopOnRequest) {
    const auto scene = wall();
    std::stop_source source;
    source.request_stop();
    EXPECT_TRUE(trace_first_hits(*scene, scene->camera(), {16, 16}, true, source.get_token()).depth.empty());
}

} // namespace
} // namespace tessera::test
