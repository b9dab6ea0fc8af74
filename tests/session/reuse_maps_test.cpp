// Maps of path reuse: the fraction of base paths with light that survive Russian roulette, and shift outcomes.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <array>
#include <cstdint>
#include <numeric>

#include <glm/vec2.hpp>
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
    settings.adapt_tile = false; // no tile splitting, so all pixels reuse paths
    return settings;
}

struct Outcome {
    ReuseMaps maps;
    Counters counters;
};

Outcome render(const RenderSettings& settings, int passes,
               const std::shared_ptr<const Scene>& scene = Room().build()) {
    ThreadPool pool(1);
    Render render(scene, scene->camera(), size, settings);
    for (int pass = 0; pass < passes; ++pass)
        render.pass(pool);
    return {render.reuse_maps(), render.counters()};
}

double sum(const Image<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0);
}

TEST(Survival, Is1WithoutRoulette) {
    for (const Method method : {Method::pr, Method::gpr, Method::gpt}) {
        const Outcome o = render(settings_of(method, RouletteKind::none), 3);
        EXPECT_EQ(o.counters.skipped_paths, 0u);
        for (const float s : o.maps.survival())
            EXPECT_TRUE(s == 1 || s == 0); // 0 for pixels without light
        EXPECT_GT(sum(o.maps.survival()), 0.9 * size.x * size.y);
    }
}

TEST(Survival, IsWithoutRouletteInGpt) {
    const Outcome o = render(settings_of(Method::gpt, RouletteKind::absolute), 2);
    for (const float s : o.maps.survival())
        EXPECT_TRUE(s == 1 || s == 0);
}

/// In one pass of PR, each base path is in one set. Survival is 0 or 1, and its sum is the counter.
TEST(Survival, AddsUpToTheCounters) {
    RenderSettings settings = settings_of(Method::pr, RouletteKind::absolute);
    settings.rr_delta = 1;
    for (const Pattern pattern : {Pattern::tile, Pattern::rooks}) {
        settings.pattern = pattern;
        const Outcome o = render(settings, 1);
        EXPECT_GT(o.counters.skipped_paths, 0u);
        EXPECT_GT(o.counters.reused_paths, 0u);
        EXPECT_EQ(sum(o.maps.survival()), static_cast<double>(o.counters.reused_paths));
    }
}

/// Over many passes, the mean survival approaches the fraction of the counters. Each pixel counts its path once
/// per set.
TEST(Survival, IsTheFractionOfPathsWithLight) {
    for (const Method method : {Method::pr, Method::gpr}) {
        RenderSettings settings = settings_of(method, RouletteKind::absolute);
        settings.rr_delta = 1;
        const Outcome o = render(settings, 64);
        const double lit = static_cast<double>(o.counters.reused_paths + o.counters.skipped_paths);
        const double expected = static_cast<double>(o.counters.reused_paths) / lit;
        EXPECT_LT(expected, 0.95);
        EXPECT_NEAR(sum(o.maps.survival()) / (size.x * size.y), expected, 0.05);
        for (const float s : o.maps.survival()) {
            EXPECT_GE(s, 0);
            EXPECT_LE(s, 1);
        }
    }
}

/// Returns a scene in which shifts fail for all reasons: slats, glass and mirrors next to rough surfaces, and
/// darkness.
std::shared_ptr<const Scene> obstacle_scene() {
    OpenRoom r;
    r.sky();
    r.sphere({-0.5f, -0.5f, 0.2f}, 0.3f, r.glass());
    r.quad({-0.9f, -0.99f, 0.9f}, {1.8f, 0, 0}, {0, 0, -0.5f}, r.mirror());
    for (int i = 0; i < 5; ++i)
        r.quad({-0.9f, -0.8f + 0.25f * static_cast<float>(i), 0.6f}, {0.8f, 0, 0}, {0, 0.06f, 0.03f}, r.w);
    return r.build();
}

using Sums = std::array<std::uint64_t, shift_outcome_count>;

Sums sums_of(const ReuseMaps& maps) {
    Sums sums{};
    for (const ReuseCounts& counts : maps.counts)
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += counts.shifts[i];
    return sums;
}

/// PR records all shifts that it tries, so the sum over pixels of each outcome is the counter.
TEST(ShiftOutcomes, AddUpToTheCounters) {
    for (const Pattern pattern : {Pattern::tile, Pattern::rooks})
        for (const ShiftKind shift : {ShiftKind::half_vector, ShiftKind::replay}) {
            RenderSettings settings = settings_of(Method::pr, RouletteKind::relative);
            settings.pattern = pattern;
            settings.shift = shift;
            const Outcome o = render(settings, 4, obstacle_scene());
            EXPECT_EQ(o.maps.passes, 4);
            EXPECT_EQ(sums_of(o.maps), o.counters.shifts);
        }
}

TEST(ShiftOutcomes, AllOccur) {
    const Outcome o = render(settings_of(Method::pr, RouletteKind::none), 64, obstacle_scene());
    const Sums sums = sums_of(o.maps);
    for (std::size_t i = 0; i < sums.size(); ++i)
        EXPECT_GT(sums[i], 0u) << to_string(static_cast<ShiftOutcome>(i));
}

/// The maps do not count shifts to pixels of other blocks.
TEST(ShiftOutcomes, AreAtMostTheCountersInGradientMethods) {
    for (const Method method : {Method::gpr, Method::gpt}) {
        const Outcome o = render(settings_of(method, RouletteKind::none), 2, obstacle_scene());
        const Sums sums = sums_of(o.maps);
        for (std::size_t i = 0; i < sums.size(); ++i)
            EXPECT_LE(sums[i], o.counters.shifts[i]);
        const double fraction = static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0})) /
                                static_cast<double>(o.counters.shift_attempts());
        EXPECT_GT(fraction, 0.9); // all shifts except those to other blocks
    }
}

TEST(ShiftOutcomes, AreEmptyForPathTracing) {
    EXPECT_TRUE(render(settings_of(Method::pt, RouletteKind::none), 1).maps.empty());
}

} // namespace

} // namespace tessera::test
