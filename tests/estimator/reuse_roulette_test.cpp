// The roulette that decides on reuse, on base paths made by hand.
#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_policy.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Base paths whose light is given; direct light is a quarter of it.
class Roulette {
public:
    Roulette(const RenderSettings& settings, const std::vector<float>& light, float scale = 1)
        : settings_(settings) {
        for (const float l : light) {
            BasePath path;
            path.direct = Rgb(0.25f * l * scale);
            path.indirect = Rgb(0.75f * l * scale);
            paths_.push_back(path);
        }
    }

    float survival(Rgb light) const {
        static const std::shared_ptr<const Scene> scene = Room().build();
        Counters counters;
        const PathReuse reuse({*scene, counters, settings_}, settings_, 0);
        std::vector<const BasePath*> set;
        for (const BasePath& path : paths_)
            set.push_back(&path);
        return ReuseRoulette(settings_.roulette, settings_, reuse, set).survival(light);
    }

private:
    RenderSettings settings_;
    std::vector<BasePath> paths_;
};

RenderSettings settings_of(RouletteKind kind) {
    RenderSettings s;
    s.roulette = kind;
    s.q_min = 0.1f;
    return s;
}

const std::vector<float> lit_in_part = {0, 0, 0, 8, 1, 0.1f, 0, 3};

TEST(ReuseRoulette, WithoutOneEveryPathSurvives) {
    const Roulette roulette(settings_of(RouletteKind::none), lit_in_part);
    for (const float l : {0.0f, 1e-30f, 0.5f, 1e30f})
        EXPECT_EQ(roulette.survival(Rgb(l)), 1);
}

TEST(ReuseRoulette, AbsoluteIsLuminanceOverDelta) {
    RenderSettings s = settings_of(RouletteKind::absolute);
    for (const float delta : {0.1f, 3.0f}) {
        s.rr_delta = delta;
        const Roulette roulette(s, lit_in_part);
        for (const Rgb light : {Rgb(0), Rgb(1e-3f), Rgb(0.03f), Rgb(0.1f, 0, 0), Rgb(0, 0, 2), Rgb(1), Rgb(1e6f)})
            EXPECT_FLOAT_EQ(roulette.survival(light), std::clamp(luminance(light) / delta, s.q_min, 1.0f));
    }
}

TEST(ReuseRoulette, RelativeIsLuminanceOverTheNoiseOfTheSet) {
    RenderSettings s = settings_of(RouletteKind::relative);
    s.rr_scale = 0.5f;
    double sum = 0, squares = 0;
    for (const double l : lit_in_part) {
        sum += l;
        squares += l * l;
    }
    const double deviation = std::sqrt(squares / 8 - sum * sum / 64);
    const Roulette roulette(s, lit_in_part);
    EXPECT_NEAR(roulette.survival(Rgb(0.9f)), 0.9 / (0.5 * deviation), 1e-5);
    EXPECT_EQ(roulette.survival(Rgb(0.01f)), s.q_min);
    EXPECT_EQ(roulette.survival(Rgb(8)), 1);
    // Reconnection leaves direct light where it is.
    s.shift = ShiftKind::reconnection;
    EXPECT_NEAR(Roulette(s, lit_in_part).survival(Rgb(0.9f)), 0.9 / (0.5 * 0.75 * deviation), 1e-5);
}

TEST(ReuseRoulette, RelativeKeepsAllOfASetThatIsLitEvenly) {
    const Roulette roulette(settings_of(RouletteKind::relative), {1, 1.01f, 0.99f, 1});
    EXPECT_EQ(roulette.survival(Rgb(0.99f)), 1);
}

TEST(ReuseRoulette, TheUnitOfLightDoesNotMatter) {
    const RenderSettings s = settings_of(RouletteKind::relative);
    const Roulette roulette(s, lit_in_part);
    for (const float scale : {1e-25f, 1e-3f, 1e3f, 1e25f})
        for (const float l : {0.3f, 1.0f, 2.0f, 5.0f})
            EXPECT_FLOAT_EQ(Roulette(s, lit_in_part, scale).survival(Rgb(l * scale)), roulette.survival(Rgb(l)));
}

} // namespace

} // namespace tessera::test
