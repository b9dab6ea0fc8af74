// replay_learning() recomputes LearnedReuse of any pass for one tile, with the same bits as the render.
#include "render/inspect/inspection.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(41, 26);

/// Returns a room in which some tiles are split and others are not.
std::shared_ptr<const Scene> half_lit_room() {
    SceneBuilder room;
    const int white = room.diffuse(Rgb(0.75f));
    room.room({white, white, white, room.mirror(), white});
    room.quad({-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, white, room.light(Rgb(9, 8, 6)));
    room.quad({-1, -0.2f, -1}, {1.2f, 0, 0}, {0, 0, 2}, white); // a shelf, below which light is indirect
    room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
    return room.build();
}

std::string bytes_of(const Inspection& seen) {
    std::string bytes;
    const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    add(seen.radiance);
    for (const InspectedSet& set : seen.sets) {
        add(set.radiance(seen.pixel));
        for (const glm::ivec2 p : set.pixels)
            add(p);
        for (const InspectedShift& s : set.shifts)
            add(s.value);
    }
    return bytes;
}

class LearningReplay : public testing::TestWithParam<RenderSettings> {};

TEST_P(LearningReplay, ReproducesSamplesOfAnyPassBitExactly) {
    const auto scene = half_lit_room();
    const RenderSettings settings = GetParam();
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(2);
    int different_without_learning = 0; // samples that differ without the learning of earlier passes
    for (int pass = 0; pass < 6; ++pass) {
        render.pass(pool);
        if (pass == 1 || pass == 3)
            continue;
        for (const glm::ivec2 pixel :
             {glm::ivec2(0, 0), {40, 25}, {16, 15}, {15, 16}, {31, 20}, {8, 22}, {25, 3}}) {
            const auto sample = [&](const LearnedReuse& learned) {
                return bytes_of(inspect(*scene, scene->camera(), size, settings, learned, pass, pixel));
            };
            const std::string own = sample(*render.newest_learned());
            EXPECT_EQ(sample(replay_learning(*scene, scene->camera(), size, settings, pass, pixel)), own)
                << "pass " << pass << ": " << pixel.x << ", " << pixel.y;
            different_without_learning += sample(LearnedReuse(size, settings)) != own;
        }
    }
    EXPECT_EQ(different_without_learning > 0, (settings.adapt_tile && can_split_tiles(settings)) ||
                                                  settings.path_guiding == Guiding::on || has_positions(settings));
}

RenderSettings settings_of(Method method, int tile = 6) {
    RenderSettings settings;
    settings.method = method;
    settings.tile = tile;
    settings.max_depth = 5;
    settings.seed = 21;
    settings.path_guiding = Guiding::off;
    return settings;
}

RenderSettings rooks() {
    RenderSettings settings = settings_of(Method::pr);
    settings.pattern = Pattern::rooks;
    return settings;
}

/// Returns settings that reuse only indirect light, so that fewer tiles are split.
RenderSettings reconnection() {
    RenderSettings settings = settings_of(Method::pr, 16);
    settings.shift = ShiftKind::reconnection;
    return settings;
}

RenderSettings guided(Method method, Guiding when = Guiding::on) {
    RenderSettings settings = settings_of(method);
    settings.path_guiding = when;
    return settings;
}

/// If there is nothing to learn, no pass is replayed. Two billion passes would take an hour.
TEST(LearningReplayOfNothing, ReturnsAtOnce) {
    const auto scene = half_lit_room();
    constexpr int pass = 2000000000;
    constexpr glm::ivec2 pixel(3, 4);
    RenderSettings whole_tiles = settings_of(Method::gpr);
    whole_tiles.adapt_tile = false;
    for (const RenderSettings& settings :
         {settings_of(Method::gpr, 1), settings_of(Method::pt), rooks(), whole_tiles}) {
        std::stop_source out_of_patience;
        std::jthread waiting([&](std::stop_token answered) {
            std::mutex mutex;
            std::unique_lock lock(mutex);
            std::condition_variable_any().wait_for(lock, answered, std::chrono::minutes(1), [] { return false; });
            if (!answered.stop_requested())
                out_of_patience.request_stop();
        });
        const LearnedReuse learned =
            replay_learning(*scene, scene->camera(), size, settings, pass, pixel, out_of_patience.get_token());
        waiting.request_stop();
        waiting.join();
        EXPECT_FALSE(out_of_patience.stop_requested());
        const auto sample = [&](const LearnedReuse& p) {
            return bytes_of(inspect(*scene, scene->camera(), size, settings, p, pass, pixel));
        };
        EXPECT_EQ(sample(learned), sample(LearnedReuse(size, settings)));
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, LearningReplay,
                         testing::Values(settings_of(Method::pt), settings_of(Method::pr),
                                         settings_of(Method::gpt), settings_of(Method::gpr), rooks(),
                                         reconnection(), guided(Method::pt), guided(Method::gpr),
                                         guided(Method::gpr, Guiding::automatic)));

} // namespace

} // namespace tessera::test
