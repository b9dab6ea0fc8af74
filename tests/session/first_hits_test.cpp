#include "render/run/first_hits.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// A wall of two thirds reflectance three units ahead, with a light far behind the camera.
std::shared_ptr<const Scene> wall() {
    SceneBuilder scene;
    const int grey = scene.diffuse({0.6f, 0.3f, 0.1f});
    scene.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
    scene.quad({-1, -1, 9}, {0, 2, 0}, {2, 0, 0}, grey, scene.light(Rgb(5)));
    scene.camera({0, 0, 3}, {0, 0, 0}, 60);
    return scene.build();
}

TEST(FirstHits, OfAWall) {
    const auto scene = wall();
    const glm::ivec2 size(33, 33);
    const FirstHits hits = trace_first_hits(*scene, scene->camera(), size);
    EXPECT_NEAR(hits.depth(16, 16), 3, 1e-4f);
    EXPECT_NEAR(hits.normal(16, 16).z, 1, 1e-5f);
    EXPECT_LT(glm::distance(hits.albedo(16, 16), Rgb(0.6f, 0.3f, 0.1f)), 1e-4f);
    // 60 degrees at 3 units see 1.73 to each side: the corner misses.
    EXPECT_EQ(hits.depth(0, 0), 0);
    EXPECT_EQ(hits.normal(0, 0), Rgb(0));
    const float slanted = hits.depth(10, 16);
    EXPECT_GT(slanted, 3.001f);
    EXPECT_NEAR(slanted, std::hypot(3.0f, 3 * 6 * 2 * std::tan(glm::radians(30.0f)) / 33), 1e-3f);
}

TEST(FirstHits, StopWhenTold) {
    const auto scene = wall();
    std::stop_source source;
    source.request_stop();
    EXPECT_TRUE(trace_first_hits(*scene, scene->camera(), {16, 16}, source.get_token()).depth.empty());
}

} // namespace
} // namespace tessera::test
