// Russian roulette on reuse, for base paths made by hand.
#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_roulette.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns a base path of one vertex with this radiance, a quarter of it direct.
BasePath path_with(Rgb light, float albedo) {
    BasePath path;
    path.reset(Random(0, 0, 0));
    path.spare();
    path.keep();
    path.direct = 0.25f * light;
    path.indirect = 0.75f * light;
    path.albedo = Rgb(albedo);
    return path;
}

/// The roulette of a set of base paths with these radiances, on surfaces of one albedo.
class Roulette {
public:
    Roulette(const RenderSettings& settings, const std::vector<float>& radiances, float scale = 1,
             float albedo = 0.5f)
        : settings_(settings), albedo_(albedo) {
        for (const float l : radiances)
            paths_.push_back(path_with(Rgb(l * scale), albedo));
    }

    float survival(Rgb light) const { return survival(path_with(light, albedo_)); }
    float survival(const BasePath& path) const {
        static const std::shared_ptr<const Scene> scene = Room().build();
        Counters counters;
        const PathReuse reuse({*scene, counters, settings_}, settings_);
        std::vector<const BasePath*> set;
        for (const BasePath& each : paths_)
            set.push_back(&each);
        return ReuseRoulette(settings_.roulette, settings_, reuse, set).survival(path);
    }

private:
    RenderSettings settings_;
    float albedo_;
    std::vector<BasePath> paths_;
};

RenderSettings settings_of(RouletteKind kind) {
    RenderSettings s;
    s.roulette = kind;
    return s;
}

const std::vector<float> partly_lit = {0, 0, 0, 8, 1, 0.1f, 0, 3};

TEST(ReuseRoulette, NoneKeepsEveryPath) {
    const Roulette roulette(settings_of(RouletteKind::none), partly_lit);
    for (const float l : {0.0f, 1e-30f, 0.5f, 1e30f})
        EXPECT_EQ(roulette.survival(Rgb(l)), 1);
}

TEST(ReuseRoulette, AbsoluteIsLuminanceOverDelta) {
    RenderSettings s = settings_of(RouletteKind::absolute);
    for (const float delta : {0.1f, 3.0f}) {
        s.rr_delta = delta;
        const Roulette roulette(s, partly_lit);
        for (const Rgb light : {Rgb(0), Rgb(1e-3f), Rgb(0.03f), Rgb(0.1f, 0, 0), Rgb(0, 0, 2), Rgb(1), Rgb(1e6f)})
            EXPECT_FLOAT_EQ(roulette.survival(light),
                            std::clamp(luminance(light) / delta, ReuseRoulette::q_min, 1.0f));
    }
}

TEST(ReuseRoulette, RelativeIsLuminanceOverTheDeviationOfTheSet) {
    RenderSettings s = settings_of(RouletteKind::relative);
    double sum = 0, squares = 0;
    for (const double l : partly_lit) {
        sum += l;
        squares += l * l;
    }
    const double deviation = std::sqrt(squares / 8 - sum * sum / 64);
    const Roulette roulette(s, partly_lit);
    EXPECT_NEAR(roulette.survival(Rgb(0.9f)), 0.9 / deviation, 1e-5);
    EXPECT_EQ(roulette.survival(Rgb(0.01f)), ReuseRoulette::q_min);
    EXPECT_EQ(roulette.survival(Rgb(8)), 1);
    // ShiftKind::reconnection does not shift direct light.
    s.shift = ShiftKind::reconnection;
    BasePath indirect = path_with(Rgb(0.9f), 0.5f);
    indirect.indirect = std::exchange(indirect.direct, Rgb(0)) + indirect.indirect;
    EXPECT_NEAR(Roulette(s, partly_lit).survival(indirect), 0.9 / (0.75 * deviation), 1e-5);
}

TEST(ReuseRoulette, RelativeKeepsAllPathsOfAnEvenlyLitSet) {
    const Roulette roulette(settings_of(RouletteKind::relative), {1, 1.01f, 0.99f, 1});
    EXPECT_EQ(roulette.survival(Rgb(0.99f)), 1);
}

TEST(ReuseRoulette, RelativeIsIndependentOfTheUnitOfRadiance) {
    const RenderSettings s = settings_of(RouletteKind::relative);
    const Roulette roulette(s, partly_lit);
    for (const float scale : {1e-25f, 1e-3f, 1e3f, 1e25f})
        for (const float l : {0.3f, 1.0f, 2.0f, 5.0f})
            EXPECT_FLOAT_EQ(Roulette(s, partly_lit, scale).survival(Rgb(l * scale)), roulette.survival(Rgb(l)));
}

/// The relative roulette uses radiance over albedo: a dark and a bright texel with the same arriving light survive
/// with the same probability.
TEST(ReuseRoulette, RelativeUsesArrivingLight) {
    const Roulette roulette(settings_of(RouletteKind::relative), partly_lit, 1, 0.8f);
    for (const float l : {0.3f, 1.0f, 2.0f})
        EXPECT_FLOAT_EQ(roulette.survival(path_with(Rgb(l * 0.02f), 0.8f * 0.02f)), roulette.survival(Rgb(l)));
    // The absolute roulette uses the radiance that leaves x_1 [Bauszat 2017].
    const Roulette absolute(settings_of(RouletteKind::absolute), partly_lit, 1, 0.8f);
    EXPECT_FLOAT_EQ(absolute.survival(path_with(Rgb(0.05f), 0.016f)),
                    absolute.survival(path_with(Rgb(0.05f), 0.8f)));
}

} // namespace

} // namespace tessera::test
