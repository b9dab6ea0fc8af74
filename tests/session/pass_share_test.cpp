// How far a pass is, as the viewer says it while there is no picture yet.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Of large pictures a first pass and the pilot before it take long: both tell how far they are.
TEST(PassShard, RisesFromThePilotOnTo1) {
    const auto scene = Room().build();
    RenderSettings settings;
    settings.method = Method::gpr;
    Render render(scene, scene->camera(), {448, 448}, settings);
    ThreadPool pool(2);
    std::atomic<float> share = 0;
    std::atomic<bool> has_ended = false;
    std::jthread pass([&] {
        render.pass(pool, {}, &share);
        has_ended = true;
    });
    std::vector<float> seen;
    while (!has_ended)
        if (const float now = share; seen.empty() || seen.back() != now)
            seen.push_back(now);
    EXPECT_GT(std::ranges::count_if(seen, [](float s) { return s > 0 && s < 0.3f; }), 0) << "of the pilot";
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(share, 1);
}

} // namespace

} // namespace tessera::test
