// Light beyond what floats hold: nothing that is not finite gets into a buffer, and what was left out is counted.
#include "render/session/render.h"
#include "tests/support/rooms.h"

#include <set>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(17, 11);
constexpr int passes = 4;

/// What the lamp sends to most places is finite; what arrives close to it is not.
std::shared_ptr<const Scene> blinding_room() {
    Room r;
    r.point({{0, 0, -0.8f}, Rgb(3e38f, 1e38f, 2e38f)});
    return r.build();
}

bool all_finite(const RgbImage& image) {
    for (const Rgb c : image)
        if (!is_finite(c))
            return false;
    return true;
}

class Refused : public testing::TestWithParam<Method> {};

TEST_P(Refused, NothingThatIsNotFiniteGetsIntoABuffer) {
    RenderSettings settings;
    settings.method = GetParam();
    settings.max_depth = 6;
    settings.tile = 4;
    settings.seed = 77;
    const auto scene = blinding_room();
    std::set<std::string> texts;
    for (const int threads : {1, 3}) {
        Render render(scene, scene->camera(), size, settings);
        ThreadPool pool(threads);
        for (int pass = 0; pass < passes; ++pass)
            render.pass(pool);
        const GradientImages images = render.images();
        EXPECT_TRUE(all_finite(images.primal));
        EXPECT_TRUE(all_finite(images.dx));
        EXPECT_TRUE(all_finite(images.dy));
        EXPECT_TRUE(all_finite(images.very_direct));
        const Counters& counters = render.counters();
        EXPECT_GT(counters.refused_samples, 0u);
        EXPECT_LT(counters.refused_samples, 100u); // not every pixel that such a path is shared with
        ASSERT_TRUE(counters.first_refused);
        EXPECT_EQ(counters.first_refused->pass, 0);
        const std::string text = refused_text(counters, settings.seed);
        EXPECT_NE(text.find("pass 0"), std::string::npos) << text;
        EXPECT_NE(text.find("seed 77"), std::string::npos) << text;
        texts.insert(text);
    }
    EXPECT_EQ(texts.size(), 1u); // whoever came first
}

/// All that a plan has learnt.
std::string learnt(ReusePlan plan) {
    std::string bytes;
    for (const auto& piece : plan.memory())
        bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    return bytes;
}

TEST(RefusedPlan, IsThatOfThePassOfTheFirst) {
    const auto scene = blinding_room();
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.max_depth = 6;
    settings.adapt_tile = true;
    settings.tile = 4;
    ThreadPool pool(1);
    for (settings.seed = 0; settings.seed < 50; ++settings.seed) {
        Render render(scene, scene->camera(), {5, 4}, settings); // few pixels: not in every pass
        while (!render.counters().first_refused && render.spp() < 20)
            render.pass(pool);
        EXPECT_EQ(render.refused_plan() != nullptr, render.counters().first_refused.has_value());
        if (!render.refused_plan() || render.spp() < 2)
            continue; // the plan of the first pass has learnt nothing
        const std::string then = learnt(*render.newest_plan());
        render.pass(pool);
        EXPECT_EQ(learnt(*render.refused_plan()), then);
        EXPECT_NE(learnt(*render.newest_plan()), then);
        return;
    }
    FAIL() << "no sample was refused in a later pass";
}

INSTANTIATE_TEST_SUITE_P(methods, Refused, testing::ValuesIn(all_methods),
                         [](const auto& p) { return std::string(short_name(p.param)); });

} // namespace

} // namespace tessera::test
