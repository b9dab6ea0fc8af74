// BVHs are watched while they are built, and given up.
#include "render/trace/intersector.h"
#include "tests/support/scene_builder.h"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// A scene of some hundred thousand triangles.
SceneBuilder large_scene() {
    SceneBuilder scene;
    const int white = scene.diffuse(Rgb(0.5f));
    for (int i = 0; i < 4; ++i)
        scene.sphere({static_cast<float>(i), 0, 0}, 0.4f, white, 200);
    scene.camera({0, 0, 4}, {0, 0, 0}, 40);
    return scene;
}

TEST(BuildMonitor, IsToldHowFarTheBvhIs) {
    const SceneBuilder scene = large_scene();
    std::atomic<int> calls = 0;
    std::atomic<bool> sound = true;
    {
        const BuildMonitor monitor([&](double share) {
            ++calls;
            sound = sound && share >= 0 && share <= 1;
            return true;
        });
        EXPECT_NE(scene.build(), nullptr);
    }
    EXPECT_GT(calls, 1);
    EXPECT_TRUE(sound);
    const int before = calls;
    EXPECT_NE(scene.build(), nullptr);
    EXPECT_EQ(calls, before); // it is over
}

TEST(BuildMonitor, EndsABuildThatIsWantedNoMore) {
    const SceneBuilder scene = large_scene();
    std::atomic<int> calls = 0;
    const BuildMonitor monitor([&](double) { return ++calls < 2; });
    EXPECT_THROW(scene.build(), std::runtime_error);
    EXPECT_GE(calls, 2);
}

} // namespace

} // namespace tessera::test
