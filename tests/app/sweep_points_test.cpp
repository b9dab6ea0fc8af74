// What a sweep renders, and the figures it draws from that.
#include "app/sweep_points.h"
#include "app/sweep_result.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using testing::ElementsAre;

std::string label(const SweepPoint& point) {
    std::string text(short_name(point.settings.method));
    for (const std::string& value : point.values)
        text += " " + value;
    return text;
}

std::vector<std::string> labels(const std::vector<Method>& methods, const std::vector<std::string>& variations) {
    std::vector<Variation> parsed;
    for (const std::string& text : variations)
        parsed.push_back(parse_variation(text));
    std::vector<std::string> result;
    for (const SweepPoint& point : sweep_points({}, methods, parsed))
        result.push_back(label(point));
    return result;
}

TEST(SweepPoints, AreAllCombinations) {
    EXPECT_THAT(labels({Method::gpr}, {}), ElementsAre("gpr"));
    EXPECT_THAT(labels({Method::gpr, Method::pr}, {"tile=2,4"}), ElementsAre("gpr 2", "gpr 4", "pr 2", "pr 4"));
    EXPECT_THAT(labels({Method::gpr}, {"tile=2,4", "roulette=relative,none"}),
                ElementsAre("gpr 2 relative", "gpr 2 none", "gpr 4 relative", "gpr 4 none"));
}

TEST(SweepPoints, WhatMakesNoDifferenceIsOnePoint) {
    EXPECT_THAT(labels({Method::pt, Method::pt}, {"tile=2,4"}), ElementsAre("pt "));
    EXPECT_THAT(labels({Method::gpr}, {"rr_delta=0.1,0.10,1", "roulette=absolute,none"}),
                ElementsAre("gpr 0.1 absolute", "gpr  none", "gpr 1 absolute"));
}

TEST(SweepPoints, CarryTheirSettings) {
    RenderSettings base;
    base.light_samples = 3;
    const auto points =
        sweep_points(base, {Method::pr}, {parse_variation("tile=5"), parse_variation("q-min=0.5")});
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].settings.tile, 5);
    EXPECT_EQ(points[0].settings.q_min, 0.5f);
    EXPECT_EQ(points[0].settings.light_samples, 3);
}

double figure(const SweepResult& result, std::string_view id) {
    for (const SweepFigure& f : sweep_figures())
        if (f.id == id)
            return f.value(result);
    ADD_FAILURE() << id;
    return 0;
}

TEST(SweepResult, TakesMeansAndDeviationsOverTheSeeds) {
    SweepResult result;
    for (double x : {1.0, 3.0}) {
        SweepRun run;
        run.cpu_seconds = x;
        run.floor_free = {0.1 * x, 0.01 * x};
        run.counters.reused_paths = 6;
        run.counters.skipped_paths = 3;
        run.counters.dark_paths = 1;
        run.counters.shifts[0] = 8;
        run.counters.shifts[1] = 2;
        result.runs.push_back(run);
    }
    EXPECT_DOUBLE_EQ(figure(result, "cpu_seconds"), 2);
    EXPECT_DOUBLE_EQ(figure(result, "cpu_seconds_deviation"), std::sqrt(2));
    EXPECT_DOUBLE_EQ(figure(result, "relmse_floor_free"), 0.2);
    EXPECT_DOUBLE_EQ(figure(result, "relmse_floor_free_standard_error"), 0.02);
    EXPECT_DOUBLE_EQ(figure(result, "relmse_floor_free_deviation"), std::sqrt(0.02));
    EXPECT_DOUBLE_EQ(figure(result, "efficiency"), 2.5);
    EXPECT_DOUBLE_EQ(figure(result, "reused_share"), 0.6);
    EXPECT_DOUBLE_EQ(figure(result, "skipped_share"), 0.3);
    EXPECT_DOUBLE_EQ(figure(result, "dark_share"), 0.1);
    EXPECT_DOUBLE_EQ(figure(result, "shift_attempts"), 10);
    EXPECT_DOUBLE_EQ(figure(result, "shift_success_share"), 0.8);
    result.runs.resize(1);
    EXPECT_TRUE(std::isnan(figure(result, "relmse_floor_free_deviation")));
    result.runs[0].floor_free.relative_mse = -1e-6;
    EXPECT_TRUE(std::isnan(figure(result, "efficiency"))) << "the error is below its noise";
}

} // namespace

} // namespace tessera::test
