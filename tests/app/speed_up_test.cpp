// Speed-up at equal error, on curves with a known speed-up.
#include "app/experiment/speed_up.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns a curve with errors scale / time times a random factor per seed. Times double, beginning with `first`.
Curve curve(double scale, double first, int stops, int seeds = 1, double noise = 0, unsigned stream = 0) {
    std::mt19937 random(stream);
    std::vector<double> factors;
    for (int seed = 0; seed < seeds; ++seed)
        factors.push_back(std::exp(noise * std::normal_distribution<double>()(random)));
    Curve curve;
    for (int i = 0; i < stops; ++i) {
        Result result;
        result.halvings = stops - 1 - i;
        for (int seed = 0; seed < seeds; ++seed) {
            Measurement m;
            m.seed = static_cast<std::uint64_t>(seed);
            m.cpu_seconds = std::ldexp(first, i);
            const double error = scale / m.cpu_seconds * factors[static_cast<std::size_t>(seed)];
            m.floor_free = {error, 0.01 * error};
            result.runs.push_back(m);
        }
        curve.push_back(result);
    }
    return curve;
}

TEST(SpeedUp, IsTheRatioOfTimesAtEqualError) {
    // Both curves span about 1 to 32 s, one with 8 times the error, so their errors overlap between 8/32 and 1.
    const SpeedUp s = speed_up(curve(8, 1, 6), curve(1, 1.1, 6));
    EXPECT_EQ(s.kind, SpeedUp::Kind::measured);
    EXPECT_NEAR(s.factor, 8, 1e-9);
    EXPECT_NEAR(s.error, 8.0 / 32, 1e-9) << "the smallest error that both curves reach";
    EXPECT_TRUE(std::isnan(s.low)) << "one seed gives no confidence interval";
    EXPECT_EQ(to_string(s), "8");
    EXPECT_NEAR(speed_up(curve(1, 1.1, 6), curve(8, 1, 6)).factor, 1.0 / 8, 1e-9);
}

TEST(Curves, HaveThePointsThatAllSeedsReach) {
    Curve all = curve(1, 1, 4, 5);
    for (Result& result : all)
        result.scene = "room";
    all[0].runs.resize(1); // the first pass of the other seeds took longer
    all[1].runs.resize(4);
    const auto scenes = curves_by_scene(all);
    ASSERT_EQ(scenes.size(), 1u);
    ASSERT_EQ(scenes[0].curves.size(), 1u);
    ASSERT_EQ(scenes[0].curves[0].size(), 2u);
    for (const Result& result : scenes[0].curves[0])
        EXPECT_EQ(result.runs.size(), 5u);
}

TEST(SpeedUp, IsABoundIfCurvesDoNotOverlap) {
    const SpeedUp fast = speed_up(curve(1000, 1, 3), curve(1, 1, 3));
    EXPECT_EQ(fast.kind, SpeedUp::Kind::at_least);
    EXPECT_NEAR(fast.factor, 4, 1e-9) << "4 s against the first measurement at 1 s";
    EXPECT_EQ(to_string(fast), "at least 4");
    const SpeedUp slow = speed_up(curve(1, 1, 3), curve(1000, 1, 3));
    EXPECT_EQ(slow.kind, SpeedUp::Kind::at_most);
    EXPECT_NEAR(slow.factor, 0.25, 1e-9);
}

/// A temporary rise, such as a firefly of one seed, does not decide when an error is reached.
TEST(SpeedUp, LevelsRisesOfTheError) {
    Curve fast = curve(1, 1, 7);
    fast[3].runs[0].floor_free.relative_mse *= 4; // errors 1, 1/2, 1/4, 1/2, 1/16: the rise is levelled
    const SpeedUp s = speed_up(curve(8, 1, 7), fast);
    EXPECT_EQ(s.kind, SpeedUp::Kind::measured);
    EXPECT_NEAR(s.error, 8.0 / 64, 1e-9);
    EXPECT_GT(s.factor, 4);
    EXPECT_LT(s.factor, 8);
}

TEST(SpeedUp, LeavesOutErrorsBelowTheirUncertainty) {
    Curve fast = curve(1, 1, 4);
    for (Result& result : fast)
        result.runs[0].floor_free.standard_error = 1;
    EXPECT_EQ(speed_up(curve(8, 1, 4), fast).kind, SpeedUp::Kind::none);
    EXPECT_EQ(to_string(speed_up(curve(8, 1, 4), fast)), "out of range");
    EXPECT_EQ(speed_up(curve(8, 1, 4), Curve(1)).kind, SpeedUp::Kind::none);
}

/// With five seeds, the interval contains the true factor in about 95 % of the experiments.
TEST(SpeedUp, ConfidenceIntervalCoversTheTruth) {
    int covered = 0;
    constexpr unsigned rounds = 300;
    for (unsigned i = 0; i < rounds; ++i) {
        const SpeedUp s = speed_up(curve(8, 1, 7, 5, 0.2, 2 * i), curve(1, 1, 7, 5, 0.2, 2 * i + 1));
        ASSERT_EQ(s.kind, SpeedUp::Kind::measured);
        EXPECT_LT(s.low, s.factor);
        EXPECT_GT(s.high, s.factor);
        covered += s.low <= 8 && 8 <= s.high;
    }
    EXPECT_GT(covered, 0.90 * rounds);
    EXPECT_LT(covered, 0.995 * rounds);
}

TEST(Curve, SlopeIsLogarithmic) {
    EXPECT_NEAR(slope_of(curve(3, 0.5, 5)), -1, 1e-9);
    EXPECT_TRUE(std::isnan(slope_of(curve(3, 0.5, 1))));
    EXPECT_TRUE(std::isnan(slope_of(Curve())));
}

TEST(Curve, ResultsAreGroupedBySceneAndPoint) {
    std::vector<Result> results(6);
    for (std::size_t i = 0; i < 6; ++i) {
        results[i].scene = i < 4 ? "a" : "b";
        results[i].setup.settings.render.method = i < 2 ? Method::pt : Method::pr;
    }
    const auto scenes = curves_by_scene(results);
    ASSERT_EQ(scenes.size(), 2u);
    EXPECT_EQ(scenes[0].curves.size(), 2u);
    EXPECT_EQ(scenes[0].curves[1].size(), 2u);
    EXPECT_EQ(scenes[1].curves.size(), 1u);
}

} // namespace

} // namespace tessera::test
