// The map of the roulette on reuse: which share of a pixel's base paths with light it left.
#include "render/session/render.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(20, 15);

RenderSettings settings_of(Method method, RouletteKind roulette) {
    RenderSettings settings;
    settings.method = method;
    settings.roulette = roulette;
    settings.tile = 5;
    settings.max_depth = 4;
    return settings;
}

struct Outcome {
    ReuseMaps maps;
    Counters counters;
};

Outcome render(const RenderSettings& settings, int passes) {
    const auto scene = Room().build();
    ThreadPool pool(1);
    Render render(scene, scene->camera(), size, settings);
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    return {render.reuse_maps(), render.counters()};
}

double sum(const Image<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0);
}

TEST(Survival, IsWholeWithoutRoulette) {
    for (const Method method : {Method::pr, Method::gpr, Method::gpt}) {
        const Outcome o = render(settings_of(method, RouletteKind::none), 3);
        EXPECT_EQ(o.counters.skipped_paths, 0u);
        for (const float s : o.maps.survival)
            EXPECT_TRUE(s == 1 || s == 0); // 0: it is never lit
        EXPECT_GT(sum(o.maps.survival), 0.9 * size.x * size.y);
    }
}

TEST(Survival, GptHasNoRouletteWhateverIsSet) {
    const Outcome o = render(settings_of(Method::gpt, RouletteKind::absolute), 2);
    for (const float s : o.maps.survival)
        EXPECT_TRUE(s == 1 || s == 0);
}

/// In one pass of PR every base path is in one set: shares are 0 or 1, and their sum is what was counted.
TEST(Survival, AddsUpToTheCounters) {
    RenderSettings settings = settings_of(Method::pr, RouletteKind::absolute);
    settings.rr_delta = 1;
    for (const Pattern pattern : {Pattern::tile, Pattern::rooks}) {
        settings.pattern = pattern;
        const Outcome o = render(settings, 1);
        EXPECT_GT(o.counters.skipped_paths, 0u);
        EXPECT_GT(o.counters.reused_paths, 0u);
        EXPECT_EQ(sum(o.maps.survival), static_cast<double>(o.counters.reused_paths));
    }
}

/// Over many passes, of pixels alike, the share is that of the counters; of the border's paths each pixel counts
/// those of its own tile alone.
TEST(Survival, IsTheShareOfThePathsWithLight) {
    for (const Method method : {Method::pr, Method::gpr}) {
        RenderSettings settings = settings_of(method, RouletteKind::absolute);
        settings.rr_delta = 1;
        const Outcome o = render(settings, 64);
        const double lit = static_cast<double>(o.counters.reused_paths + o.counters.skipped_paths);
        const double expected = static_cast<double>(o.counters.reused_paths) / lit;
        EXPECT_LT(expected, 0.95);
        EXPECT_NEAR(sum(o.maps.survival) / (size.x * size.y), expected, 0.05);
        EXPECT_GE(*std::min_element(o.maps.survival.begin(), o.maps.survival.end()), 0);
        EXPECT_LE(*std::max_element(o.maps.survival.begin(), o.maps.survival.end()), 1);
    }
}

} // namespace

} // namespace tessera::test
