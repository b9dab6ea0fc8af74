// Verdicts on synthetic images with a known truth.
#include "app/experiment/stability.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int width = 64, height = 48, seeds = 12;
constexpr double level = 1e-5;

Rgb truth(int x, int y) {
    return Rgb(0.2f, 0.5f, 0.3f) * (1 + 0.5f * std::sin(0.2f * float(x)) + float(y) / height);
}

/// Expected value of a method at a pixel.
using Mean = std::function<Rgb(int x, int y)>;

/// Returns the mean image with noise. The standard deviation is relative to the truth.
RgbImage noisy(const Mean& mean, double deviation, std::mt19937& random, glm::ivec2 size = {width, height}) {
    std::normal_distribution<double> normal;
    RgbImage image(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image(x, y) = mean(x, y) + truth(x, y) * float(deviation * normal(random));
    return image;
}

/// Suite of one scene: its references, and the runs of methods.
class Suite {
public:
    explicit Suite(double reference_noise = 0.02, glm::ivec2 size = {width, height}) : size_(size) {
        for (RgbImage& half : halves_)
            half = noisy(truth, reference_noise, random_, size_);
        pt_ = result(truth, 0.3, Method::pt);
    }

    Result result(const Mean& mean, double deviation, Method method = Method::pr, Norm norm = Norm::none) {
        Result result;
        result.setup.settings.size = size_;
        result.setup.settings.render.method = method;
        result.setup.settings.reconstruction = {.norm = norm};
        for (int seed = 0; seed < seeds; ++seed) {
            Measurement m;
            m.seed = static_cast<std::uint64_t>(seed);
            m.spp = 16;
            m.cpu_seconds = 2;
            m.artefacts = measure_artefacts(noisy(mean, deviation, random_, size_), halves_[0], halves_[1]);
            result.runs.push_back(m);
        }
        return result;
    }

    Findings findings(const Result& result) {
        return find(result, pt_, measure_reference_noise(halves_[0], halves_[1]));
    }
    Verdict verdict(const Result& result) { return judge(findings(result), findings(pt_), level); }
    Verdict verdict(const Mean& mean, double deviation, Norm norm = Norm::none) {
        return verdict(result(mean, deviation, Method::gpr, norm));
    }

    glm::ivec2 size_;
    std::mt19937 random_{1};
    std::array<RgbImage, 2> halves_;
    Result pt_;
};

TEST(Verdict, UnbiasedMethodIsOkWithANoisyReference) {
    for (double reference_noise : {0.0, 0.02, 0.3}) {
        Suite suite(reference_noise);
        const Verdict v = suite.verdict(truth, 0.3);
        EXPECT_EQ(v.kind, Verdict::Kind::ok) << v.cause;
        EXPECT_LT(suite.findings(suite.pt_).squared_bias.sigmas, 4);
    }
}

TEST(Verdict, OnePieceGivesNoBias) {
    for (double reference_noise : {0.02, 0.1, 0.3, 0.5}) {
        Suite suite(reference_noise, {8, 8});
        const Findings f = suite.findings(suite.pt_);
        EXPECT_EQ(f.squared_bias.sigmas, 0) << "one piece has no standard error";
        const Verdict v = suite.verdict(truth, 0.3);
        EXPECT_EQ(v.kind, Verdict::Kind::ok) << v.cause;
    }
}

TEST(Verdict, FalseAlarmsAreRare) {
    int alarms = 0;
    Suite suite;
    for (int i = 0; i < 100; ++i) {
        const Findings f = suite.findings(suite.result(truth, 0.5));
        alarms += f.energy.sigmas > 2.576 || f.squared_bias.sigmas > 2.576; // each with a probability of 1 %
    }
    EXPECT_LE(alarms, 8);
}

TEST(Verdict, FindsLostEnergyBelowTheNoise) {
    Suite suite;
    const Mean dark = [](int x, int y) { return 0.98f * truth(x, y); };
    const Verdict v = suite.verdict(dark, 0.3);
    EXPECT_EQ(v.kind, Verdict::Kind::fails);
    EXPECT_THAT(v.cause, HasSubstr("energy lost by "));
    EXPECT_THAT(v.cause, HasSubstr(" sigma"));
    const Deviation energy = suite.findings(suite.result(dark, 0.3)).energy;
    EXPECT_NEAR(energy.value, -0.02, 0.006) << "four standard errors";
    EXPECT_NEAR(energy.error, 0.3 / std::sqrt(width * height * seeds), 0.001);
    EXPECT_EQ(suite.verdict(dark, 0.3, Norm::l1).kind, Verdict::Kind::ok) << "a biased norm may lose 2 %";
    EXPECT_EQ(suite.verdict(dark, 0.3, Norm::smoothed).kind, Verdict::Kind::ok) << "the denoiser may lose 2 %";
    EXPECT_EQ(suite.verdict([](int x, int y) { return 0.9f * truth(x, y); }, 0.3, Norm::l1).kind,
              Verdict::Kind::fails);
}

TEST(Verdict, FindsABiasThatKeepsTheEnergy) {
    Suite suite;
    const Mean wavy = [](int x, int y) { return truth(x, y) * (x / 8 % 2 ? 1.03f : 0.97f); };
    const Findings f = suite.findings(suite.result(wavy, 0.3));
    EXPECT_NEAR(std::sqrt(f.squared_bias.value), 0.03, 0.006);
    EXPECT_LT(f.energy.sigmas, 4);
    const Verdict v = suite.verdict(wavy, 0.3);
    EXPECT_EQ(v.kind, Verdict::Kind::fails);
    EXPECT_THAT(v.cause, HasSubstr("biased by "));
}

TEST(Verdict, LimitsTheBiasOfReconstructions) {
    Suite suite;
    const auto wavy = [](float by) -> Mean {
        return [by](int x, int y) { return truth(x, y) * (x / 8 % 2 ? 1 + by : 1 - by); };
    };
    EXPECT_EQ(suite.verdict(wavy(0.03f), 0.2, Norm::weighted).kind, Verdict::Kind::ok);
    const Verdict v = suite.verdict(wavy(0.2f), 0.2, Norm::weighted);
    EXPECT_EQ(v.kind, Verdict::Kind::fails);
    EXPECT_THAT(v.cause, HasSubstr("biased by 2"));
}

TEST(Verdict, LightMissingInTheReferenceIsUndecided) {
    // All methods, including PT, have the additional light.
    Suite suite;
    const Mean lit = [](int x, int y) { return 1.05f * truth(x, y); };
    suite.pt_ = suite.result(lit, 0.3, Method::pt);
    EXPECT_EQ(suite.verdict(lit, 0.3).kind, Verdict::Kind::undecided);
}

TEST(Verdict, OneNonFinitePixelFails) {
    Suite suite;
    RgbImage image = noisy(truth, 0.3, suite.random_);
    image(3, 4) = Rgb(0, std::numeric_limits<float>::quiet_NaN(), 0);
    Result result = suite.result(truth, 0.3);
    result.runs[5].artefacts = measure_artefacts(image, suite.halves_[0], suite.halves_[1]);
    const Verdict v = suite.verdict(result);
    EXPECT_EQ(v.kind, Verdict::Kind::fails);
    EXPECT_EQ(v.cause, "not finite: 1 pixels");
}

TEST(Verdict, WorseMethodHasAFactorAndInterval) {
    Suite suite;
    const Findings f = suite.findings(suite.result(truth, 0.6));
    EXPECT_NEAR(f.factor, 4, 0.3) << "twice the standard deviation";
    EXPECT_LT(f.low, 4);
    EXPECT_GT(f.high, 4);
    EXPECT_GT(f.low, 2.5);
    const Verdict v = suite.verdict(truth, 0.6);
    EXPECT_EQ(v.kind, Verdict::Kind::worse);
    EXPECT_THAT(v.cause, HasSubstr("times PT's error at equal time: "));
    EXPECT_THAT(v.cause, HasSubstr("costs 1 times"));
    EXPECT_THAT(v.cause, Not(HasSubstr("shifts"))) << "no shift was tried";

    Result slow = suite.result(truth, 0.3);
    for (Measurement& m : slow.runs)
        m.cpu_seconds *= 3;
    EXPECT_NEAR(suite.findings(slow).factor, 3, 0.3) << "error at equal time";
    EXPECT_THAT(suite.verdict(slow).cause, HasSubstr("costs 3 times"));
    EXPECT_EQ(suite.verdict(truth, 0.1).kind, Verdict::Kind::ok);
    EXPECT_NEAR(suite.findings(suite.result(truth, 0.1)).factor, 1.0 / 9, 0.02);
}

TEST(Verdict, WorseMethodHasSampleCostAndShiftFailures) {
    Suite suite;
    Result result = suite.result(truth, 0.6, Method::gpr);
    for (Measurement& m : result.runs) {
        m.spp = 4; // in the time of 16 samples of PT
        m.counters.shifts[static_cast<int>(ShiftOutcome::ok)] = 10;
        m.counters.shifts[static_cast<int>(ShiftOutcome::occluded)] = 30;
        m.counters.shifts[static_cast<int>(ShiftOutcome::kind_mismatch)] = 60;
    }
    const Verdict v = suite.verdict(result);
    EXPECT_EQ(v.kind, Verdict::Kind::worse);
    EXPECT_THAT(v.cause,
                HasSubstr("costs 4 times as much; only 10 % of the shifts succeed (main failure: kind_mismatch)"));
    for (Measurement& m : result.runs)
        m.counters.shifts[static_cast<int>(ShiftOutcome::ok)] = 1000;
    EXPECT_THAT(suite.verdict(result).cause, Not(HasSubstr("shifts")));
}

TEST(Verdict, ErrorsBelowTheReferenceNoiseGiveNoFactor) {
    Suite suite(0.3);
    EXPECT_TRUE(std::isnan(suite.findings(suite.result(truth, 1e-3)).factor));
}

TEST(Verdict, FirefliesOfTheReferenceDoNotCount) {
    Suite suite;
    suite.halves_[0](10, 10) *= 1000.0f;
    Result result = suite.result(truth, 0.1);
    EXPECT_LT(suite.findings(result).worst, 1.1);
    RgbImage image = noisy(truth, 0.1, suite.random_);
    image(20, 30) = truth(20, 30) * 201.0f;
    result.runs[0].artefacts = measure_artefacts(image, suite.halves_[0], suite.halves_[1]);
    const Findings f = suite.findings(result);
    EXPECT_NEAR(f.worst, 200, 3);
    EXPECT_EQ(f.worst_pixel, glm::ivec2(20, 30));
    EXPECT_LT(f.spike, 2) << "3 of 36864 pixels are above it";
    EXPECT_GT(f.worst_fraction, 0.9);
}

TEST(Verdict, BlackSceneAcceptsOnlyBlack) {
    Suite suite;
    suite.halves_ = {RgbImage(width, height), RgbImage(width, height)};
    const Mean black = [](int, int) { return Rgb(0); };
    suite.pt_ = suite.result(black, 0, Method::pt);
    EXPECT_EQ(suite.verdict(black, 0).kind, Verdict::Kind::ok);
    const Verdict v = suite.verdict([](int, int) { return Rgb(0.01f); }, 0);
    EXPECT_EQ(v.kind, Verdict::Kind::fails);
    EXPECT_THAT(v.cause, HasSubstr("energy gained"));
}

} // namespace

} // namespace tessera::test
