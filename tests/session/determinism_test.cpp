// The same seed gives the same bits for any number of threads, headless and in a session.
#include "render/run/render.h"
#include "render/session/session.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(53, 37);
constexpr int passes = 5;

std::shared_ptr<const Scene> scene() {
    for (const TestScene& t : all_test_scenes())
        if (t.name == "patchwork")
            return t.scene;
    return nullptr;
}

/// Settings with the name of the test case.
struct Variant {
    std::string name;
    RenderSettings settings;
};

void PrintTo(const Variant& v, std::ostream* out) {
    *out << v.name;
}

RenderSettings settings_for(Method method) {
    RenderSettings s;
    s.method = method;
    s.tile = 5;
    s.max_depth = 5;
    s.seed = 42;
    return s;
}

/// Returns variants of every setting that affects random numbers or reuse sets.
std::vector<Variant> variants() {
    std::vector<Variant> list;
    const auto add = [&](std::string name, Method method, const std::function<void(RenderSettings&)>& change) {
        list.push_back({std::move(name), settings_for(method)});
        change(list.back().settings);
    };
    using S = RenderSettings;
    for (const Method method : all_methods)
        add(std::string(short_name(method)), method, [](S&) {});
    add("rooks", Method::pr, [](S& s) { s.pattern = Pattern::rooks; });
    add("rooks_replay", Method::pr, [](S& s) { s.pattern = Pattern::rooks, s.shift = ShiftKind::replay; });
    add("reconnection", Method::pr, [](S& s) { s.shift = ShiftKind::reconnection; });
    add("replay", Method::gpr, [](S& s) { s.shift = ShiftKind::replay; });
    add("replay_reconnection", Method::gpr, [](S& s) { s.shift = ShiftKind::replay_reconnection; });
    add("half_vectors", Method::gpr, [](S& s) { s.shift_threshold = 0.1f; });
    add("roulette_depth", Method::gpr, [](S& s) { s.roulette_depth = 1; });
    add("absolute_roulette", Method::gpr, [](S& s) { s.roulette = RouletteKind::absolute; });
    add("no_roulette", Method::gpr, [](S& s) { s.roulette = RouletteKind::none; });
    add("basis_components_of_gpr", Method::gpr, [](S& s) { s.basis = Basis::sh2; });
    add("basis_components_of_gpt", Method::gpt, [](S& s) { s.basis = Basis::box; });
    add("path_guiding", Method::gpr, [](S& s) { s.path_guiding = Guiding::on; });
    add("path_guiding_of_path_tracing", Method::pt, [](S& s) { s.path_guiding = Guiding::on; });
    add("no_edge_rays", Method::gpr, [](S& s) { s.edge_rays = false; });
    add("no_tile_splitting", Method::gpr, [](S& s) { s.adapt_tile = false; });
    return list;
}

template <class Pixel>
bool same_bits(const Image<Pixel>& a, const Image<Pixel>& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Pixel)) == 0);
}

bool same_bits(const Demodulation& a, const Demodulation& b) {
    return same_bits(a.value, b.value) && same_bits(a.albedo, b.albedo) &&
           same_bits(a.sampled_albedo, b.sampled_albedo) && same_bits(a.albedo_variance, b.albedo_variance) &&
           same_bits(a.sampled_weight, b.sampled_weight) && same_bits(a.sampled_variance, b.sampled_variance) &&
           same_bits(a.value_covariance, b.value_covariance) &&
           same_bits(a.unexplained_variance, b.unexplained_variance);
}

bool same_bits(const BasisComponent& a, const BasisComponent& b) {
    return same_bits(a.projection, b.projection) && same_bits(a.primal, b.primal) && same_bits(a.dx, b.dx) &&
           same_bits(a.dy, b.dy) && same_bits(a.primal_variance, b.primal_variance) &&
           same_bits(a.dx_variance, b.dx_variance) && same_bits(a.dy_variance, b.dy_variance);
}

bool same_bits(const GradientImages& a, const GradientImages& b) {
    return same_bits(a.primal, b.primal) && same_bits(a.dx, b.dx) && same_bits(a.dy, b.dy) &&
           same_bits(a.very_direct, b.very_direct) && same_bits(a.primal_variance, b.primal_variance) &&
           same_bits(a.dx_variance, b.dx_variance) && same_bits(a.dy_variance, b.dy_variance) &&
           same_bits(a.demodulation, b.demodulation) &&
           std::ranges::equal(a.components, b.components,
                              [](const auto& p, const auto& q) { return same_bits(p, q); });
}

GradientImages render(const RenderSettings& settings, int threads) {
    ThreadPool pool(threads);
    const auto s = scene();
    Render render(s, s->camera(), size, settings);
    for (int i = 0; i < passes; ++i)
        EXPECT_TRUE(render.pass(pool));
    return render.images();
}

class Threads : public testing::TestWithParam<Variant> {};

TEST_P(Threads, AnyNumberGivesTheSameBits) {
    const RenderSettings& settings = GetParam().settings;
    const GradientImages one = render(settings, 1);
    for (const int threads : {2, 3, 8})
        EXPECT_TRUE(same_bits(one, render(settings, threads))) << threads;
}

INSTANTIATE_TEST_SUITE_P(variants, Threads, testing::ValuesIn(variants()),
                         [](const auto& p) { return p.param.name; });

class Determinism : public testing::TestWithParam<Method> {};

TEST_P(Determinism, TakeImagesEqualsImages) {
    ThreadPool pool(1);
    const auto s = scene();
    Render render(s, s->camera(), size, settings_for(GetParam()));
    EXPECT_TRUE(render.pass(pool));
    const GradientImages seen = render.images();
    EXPECT_TRUE(same_bits(seen, render.take_images()));
    EXPECT_TRUE(render.images().primal.empty()); // moved out
}

TEST_P(Determinism, AnotherSeedGivesAnotherImage) {
    RenderSettings settings = settings_for(GetParam());
    const GradientImages one = render(settings, 2);
    ++settings.seed;
    EXPECT_FALSE(same_bits(one, render(settings, 2)));
}

TEST_P(Determinism, SessionMatchesAHeadlessRender) {
    Session session(2, 2);
    session.set_pace({Pace::Equal::time, passes, 0});
    const auto s = scene();
    for (int pane = 0; pane < 2; ++pane)
        session.submit(pane, {s, s->camera(), size, settings_for(GetParam())});
    std::shared_ptr<const Snapshot> snapshot;
    for (int i = 0; i < 2000 && (!snapshot || snapshot->coarse() || snapshot->spp < passes); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        snapshot = session.latest(1);
    }
    ASSERT_TRUE(snapshot);
    ASSERT_EQ(snapshot->spp, passes);
    EXPECT_TRUE(same_bits(*snapshot->images, render(settings_for(GetParam()), 1)));
}

INSTANTIATE_TEST_SUITE_P(methods, Determinism, testing::ValuesIn(all_methods),
                         [](const auto& p) { return std::string(short_name(p.param)); });

} // namespace

} // namespace tessera::test
