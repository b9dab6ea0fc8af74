// The same seed gives the same bits for any number of threads, headless and in a session.
#include "render/session/render.h"
#include "render/session/session.h"
#include "tests/support/scene_builder.h"

#include <chrono>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(53, 37);
constexpr int passes = 3;

std::shared_ptr<const Scene> scene() {
    for (const TestScene& t : all_test_scenes())
        if (t.name == "patchwork")
            return t.scene;
    return nullptr;
}

RenderSettings settings_for(Method method) {
    RenderSettings s;
    s.method = method;
    s.tile = 5;
    s.max_depth = 5;
    s.seed = 42;
    return s;
}

bool same_bits(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(Rgb)) == 0;
}

bool same_bits(const GradientImages& a, const GradientImages& b) {
    return same_bits(a.primal, b.primal) && same_bits(a.dx, b.dx) && same_bits(a.dy, b.dy) &&
           same_bits(a.very_direct, b.very_direct);
}

GradientImages render(Method method, int threads, std::uint64_t seed = 42) {
    ThreadPool pool(threads);
    const auto s = scene();
    RenderSettings settings = settings_for(method);
    settings.seed = seed;
    Render render(s, s->camera(), size, settings);
    for (int i = 0; i < passes; ++i)
        EXPECT_TRUE(render.pass(pool));
    return render.images();
}

class Determinism : public testing::TestWithParam<Method> {};

TEST_P(Determinism, SameBitsForAnyNumberOfThreads) {
    const GradientImages one = render(GetParam(), 1);
    EXPECT_TRUE(same_bits(one, render(GetParam(), 2)));
    EXPECT_TRUE(same_bits(one, render(GetParam(), 8)));
}

TEST_P(Determinism, ImagesAreTakenAsTheyAreSeen) {
    ThreadPool pool(1);
    const auto s = scene();
    Render render(s, s->camera(), size, settings_for(GetParam()));
    EXPECT_TRUE(render.pass(pool));
    const GradientImages seen = render.images();
    EXPECT_TRUE(same_bits(seen, render.take_images()));
    EXPECT_TRUE(render.images().primal.empty()); // given up
}

TEST_P(Determinism, AnotherSeedGivesAnotherPicture) {
    EXPECT_FALSE(same_bits(render(GetParam(), 2, 42), render(GetParam(), 2, 43)));
}

TEST_P(Determinism, SessionGivesTheBitsOfAHeadlessRender) {
    Session session(2, 2);
    const auto s = scene();
    for (int pane = 0; pane < 2; ++pane)
        session.submit(pane, {s, s->camera(), size, settings_for(GetParam()), passes});
    std::shared_ptr<const Snapshot> snapshot;
    for (int i = 0; i < 2000 && (!snapshot || snapshot->coarse || snapshot->spp < passes); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        snapshot = session.latest(1);
    }
    ASSERT_TRUE(snapshot);
    ASSERT_EQ(snapshot->spp, passes);
    EXPECT_TRUE(same_bits(*snapshot->images, render(GetParam(), 1)));
}

INSTANTIATE_TEST_SUITE_P(methods, Determinism, testing::ValuesIn(all_methods),
                         [](const auto& p) { return std::string(short_name(p.param)); });

} // namespace

} // namespace tessera::test
