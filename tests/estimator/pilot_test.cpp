// Statistics that the pilot pass measures. learned_reuse_test.cpp tests their use, judge_test.cpp that they add no
// bias.
#include "render/estimator/pilot.h"
#include "tests/support/scene_builder.h"

#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(16, 16);

/// Returns a scene of a floor and a wall under a sky with one bright pixel, so that samples are noisy.
std::shared_ptr<const Scene> corner(float brightness) {
    SceneBuilder b;
    b.quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, b.diffuse(Rgb(0.5f)));
    b.quad({-4, -1, 0}, {0, 0, 4}, {8, 0, 0}, b.diffuse(Rgb(0.8f, 0.5f, 0.3f)));
    std::vector<Rgb> sky(8, Rgb(brightness));
    sky[2] = Rgb(64 * brightness);
    b.environment(sky, 4);
    b.camera({look_at({0, 0.5f, 4}, {0, -0.5f, 0}), 40, FovAxis::x});
    return b.build();
}

CellStatistics explore(const Scene& scene, PixelRect cell) {
    const RenderSettings settings;
    const LearnedReuse learned(size, settings);
    const Pilot pilot(scene, scene.camera(), size, settings, learned);
    Worker worker(scene, scene.camera(), size, settings, nullptr);
    return pilot.explore(cell, worker);
}

} // namespace

TEST(Pilot, WeightsSetsByTheRootOfTheirNoise) {
    const auto scene = corner(1);
    const CellStatistics whole = explore(*scene, {0, 0, 16, 16}), left = explore(*scene, {0, 0, 8, 16}),
                         right = explore(*scene, {8, 0, 16, 16}), brighter = explore(*corner(4), {0, 0, 16, 16});
    EXPECT_GT(whole.own_noise, whole.reuse_noise);
    EXPECT_GT(whole.reuse_noise, 0);
    EXPECT_NEAR(whole.own_noise, left.own_noise + right.own_noise, 1e-9 * whole.own_noise);
    EXPECT_NEAR(whole.reuse_noise, left.reuse_noise + right.reuse_noise, 1e-9 * whole.reuse_noise);
    EXPECT_NEAR(brighter.own_noise, 2 * whole.own_noise, 1e-6 * whole.own_noise);
    EXPECT_NEAR(brighter.reuse_noise, 2 * whole.reuse_noise, 1e-6 * whole.reuse_noise);
}

} // namespace tessera::test
