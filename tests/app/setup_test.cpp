// Setups that a sweep renders, and columns of its results.
#include "app/cli/terminal.h"
#include "app/experiment/result.h"
#include "app/experiment/setup.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using testing::ElementsAre;

std::string label(const Setup& setup) {
    std::string text = name_of(setup);
    for (const std::string& value : setup.values)
        text += " " + value;
    return text;
}

std::vector<std::string> labels(const std::vector<Method>& methods, const std::vector<Norm>& norms,
                                const std::vector<std::string>& variations) {
    std::vector<Variation> parsed;
    for (const std::string& text : variations)
        parsed.push_back(parse_variation(text));
    std::vector<std::string> result;
    for (const Setup& setup : setups_of({}, methods, norms, parsed))
        result.push_back(label(setup));
    return result;
}

TEST(Setups, AreAllCombinations) {
    EXPECT_THAT(labels({Method::gpr}, {Norm::l2}, {}), ElementsAre("gpr-l2"));
    EXPECT_THAT(labels({Method::gpr, Method::pr}, {Norm::l2}, {"tile=2,4"}),
                ElementsAre("gpr-l2 2", "gpr-l2 4", "pr 2", "pr 4"));
    EXPECT_THAT(labels({Method::gpr}, {Norm::l2}, {"tile=2,4", "roulette=relative,none"}),
                ElementsAre("gpr-l2 2 relative", "gpr-l2 2 none", "gpr-l2 4 relative", "gpr-l2 4 none"));
}

TEST(Setups, HaveAllReconstructionsIfTheyHaveGradients) {
    EXPECT_THAT(labels({Method::pt, Method::gpt}, {Norm::l2, Norm::l1}, {}),
                ElementsAre("pt", "gpt-l2", "gpt-l1"));
    EXPECT_THAT(labels({Method::pr, Method::gpr}, {Norm::l2}, {"recon=none,mixed", "alpha=0.1,0.2"}),
                ElementsAre("pr  ", "gpr-none none ", "gpr-mixed mixed 0.1", "gpr-mixed mixed 0.2"));
    EXPECT_THAT(labels({Method::pt, Method::gpt}, {Norm::guided, Norm::smoothed}, {}),
                ElementsAre("pt", "pt-smoothed", "gpt-guided", "gpt-smoothed"));
    EXPECT_THAT(labels({Method::gpr}, {Norm::uniform}, {"alpha=0.1,0.2"}), ElementsAre("gpr-uniform "))
        << "uniform reconstruction has no alpha";
}

TEST(Setups, AreMergedIfSettingsMakeNoDifference) {
    EXPECT_THAT(labels({Method::pt, Method::pt}, {Norm::l2}, {"tile=2,4"}), ElementsAre("pt "));
    EXPECT_THAT(labels({Method::gpr}, {Norm::l2}, {"rr_delta=0.1,0.10,1", "roulette=absolute,none"}),
                ElementsAre("gpr-l2 0.1 absolute", "gpr-l2  none", "gpr-l2 1 absolute"));
}

TEST(Setups, HaveTheirSettings) {
    PictureSettings base;
    base.render.roulette_depth = 5;
    const auto setups =
        setups_of(base, {Method::pr}, {Norm::l2}, {parse_variation("tile=5"), parse_variation("rr-delta=0.5")});
    ASSERT_EQ(setups.size(), 1u);
    EXPECT_EQ(setups[0].settings.render.tile, 5);
    EXPECT_EQ(setups[0].settings.render.rr_delta, 0.5f);
    EXPECT_EQ(setups[0].settings.render.roulette_depth, 5);
}

TEST(Variable, CanVaryOtherThanRenderSettings) {
    PictureSettings s;
    variable_named("size").set_text(s, "160x90");
    variable_named("threads").set_text(s, "3");
    variable_named("alpha").set_text(s, "0.5");
    variable_named("recon").set_text(s, "l1");
    variable_named("max-depth").set_text(s, "4");
    variable_named("rr-delta").set_text(s, "0.25");
    EXPECT_EQ(s.size, glm::ivec2(160, 90));
    EXPECT_EQ(s.threads, 3);
    EXPECT_EQ(s.reconstruction.alpha, 0.5f);
    EXPECT_EQ(s.reconstruction.norm, Norm::l1);
    EXPECT_EQ(s.render.max_depth, 4);
    EXPECT_EQ(variable_named("size").text(s), "160x90");
    EXPECT_EQ(variable_named("size").number(s), 14400);
    EXPECT_EQ(variable_named("rr-delta").number(s), 0.25);
    EXPECT_EQ(variable_named("recon").number(s), std::nullopt);
}

TEST(Variable, RejectsInvalidValues) {
    for (const char* text : {"size=0x3", "size=3", "threads=0", "threads=1.5", "alpha=0", "alpha=nan", "recon=l3",
                             "threads=2000", "alpha=", "seed=1,2"})
        EXPECT_THROW(parse_variation(text), BadInput) << text;
}

TEST(Result, TakesMeansAndDeviationsOverTheSeeds) {
    Result result;
    for (double x : {1.0, 3.0}) {
        Measurement run;
        run.cpu_seconds = x;
        run.floor_free = {0.1 * x, 0.01 * x};
        run.counters.reused_paths = 6;
        run.counters.skipped_paths = 3;
        run.counters.dark_paths = 1;
        run.counters.shifts[0] = 8;
        run.counters.shifts[1] = 2;
        result.runs.push_back(run);
    }
    EXPECT_DOUBLE_EQ(column_value("cpu_seconds", result), 2);
    EXPECT_DOUBLE_EQ(column_value("cpu_seconds_deviation", result), std::sqrt(2));
    EXPECT_DOUBLE_EQ(column_value("relmse_floor_free", result), 0.2);
    EXPECT_DOUBLE_EQ(column_value("relmse_floor_free_uncertainty", result), 0.1)
        << "standard error from two seeds";
    EXPECT_DOUBLE_EQ(column_value("relmse_floor_free_deviation", result), std::sqrt(0.02));
    EXPECT_DOUBLE_EQ(column_value("efficiency", result), 2.5);
    EXPECT_DOUBLE_EQ(column_value("reused_share", result), 0.6);
    EXPECT_DOUBLE_EQ(column_value("skipped_share", result), 0.3);
    EXPECT_DOUBLE_EQ(column_value("dark_share", result), 0.1);
    EXPECT_DOUBLE_EQ(column_value("shift_attempts", result), 10);
    EXPECT_DOUBLE_EQ(column_value("shift_success_share", result), 0.8);
    result.runs.resize(1);
    EXPECT_TRUE(std::isnan(column_value("relmse_floor_free_deviation", result)));
    result.runs[0].floor_free.relative_mse = -1e-6;
    EXPECT_TRUE(std::isnan(column_value("efficiency", result))) << "the error is below its noise";
    result.runs[0].floor_free = {0.01, 0.02};
    EXPECT_TRUE(std::isnan(column_value("relmse_floor_free", result))) << "the error is below its uncertainty";
    EXPECT_EQ(column_value("relmse_floor_free_uncertainty", result), 0.02);
    EXPECT_EQ(column_value("below_uncertainty", result), 1);
}

} // namespace

} // namespace tessera::test
