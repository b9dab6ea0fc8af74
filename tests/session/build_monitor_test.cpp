// BuildMonitor reports the progress of a BVH build and can cancel it.
#include "render/trace/intersector.h"
#include "tests/support/scene_builder.h"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns a scene of some hundred thousand triangles.
SceneBuilder large_scene() {
    SceneBuilder scene;
    const int white = scene.diffuse(Rgb(0.5f));
    for (int i = 0; i < 4; ++i)
        scene.sphere({static_cast<float>(i), 0, 0}, 0.4f, white, 200);
    scene.camera({0, 0, 4}, {0, 0, 0}, 40);
    return scene;
}

TEST(BuildMonitor, ReceivesTheProgressOfABuild) {
    const SceneBuilder scene = large_scene();
    std::atomic<int> calls = 0;
    std::atomic<bool> in_range = true;
    {
        const BuildMonitor monitor([&](double progress) {
            ++calls;
            in_range = in_range && progress >= 0 && progress <= 1;
            return true;
        });
        EXPECT_NE(scene.build(), nullptr);
    }
    EXPECT_GT(calls, 1);
    EXPECT_TRUE(in_range);
    const int before = calls;
    EXPECT_NE(scene.build(), nullptr);
    EXPECT_EQ(calls, before); // the destroyed monitor receives no calls
}

TEST(BuildMonitor, CancelsABuild) {
    const SceneBuilder scene = large_scene();
    std::atomic<int> calls = 0;
    const BuildMonitor monitor([&](double) { return ++calls < 2; });
    EXPECT_THROW(scene.build(), std::runtime_error);
    EXPECT_GE(calls, 2);
}

} // namespace

} // namespace tessera::test
