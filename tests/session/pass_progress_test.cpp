// Progress of a pass, which the viewer shows before the first picture.
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

/// In large pictures, the pilot pass and the first pass are slow, and both report progress.
TEST(PassProgress, RisesFromThePilotPassTo1) {
    const auto scene = Room().build();
    RenderSettings settings;
    settings.method = Method::gpr;
    Render render(scene, scene->camera(), {448, 448}, settings);
    ThreadPool pool(2);
    std::atomic<float> progress = 0;
    std::atomic<bool> has_ended = false;
    std::jthread pass([&] {
        render.pass(pool, {}, &progress);
        has_ended = true;
    });
    std::vector<float> seen;
    while (!has_ended)
        if (const float current = progress; seen.empty() || seen.back() != current)
            seen.push_back(current);
    EXPECT_GT(std::ranges::count_if(seen, [](float s) { return s > 0 && s < 0.3f; }), 0)
        << "progress of the pilot pass";
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_EQ(progress, 1);
}

} // namespace

} // namespace tessera::test
