// Z-tests of every method against the naive path tracer, on every small scene: primal, gradients and unbiased
// reconstructions, also at borders and in incomplete tiles.
#include "render/run/render.h"
#include "tests/support/scene_builder.h"
#include "tests/support/z_scores.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int naive_samples = 32768;
constexpr int runs = 96; // stratified samples have long tails, so standard errors need many runs
constexpr int passes = 8;

// Sizes of the pictures, pixels; no multiples of tiles. The small one takes a third of the time. Its z-tests have
// wider limits, as it has fewer pixels: they detect only a bias twice as large. Fewer samples instead would leave
// too many outliers from rare bright paths.
constexpr glm::ivec2 small(7, 5);
constexpr glm::ivec2 large(13, 9);

struct Variant {
    std::string name;
    RenderSettings settings;
};

Variant variant(std::string name, Method method, int tile,
                const std::function<void(RenderSettings&)>& change = {}) {
    RenderSettings s;
    s.method = method;
    s.tile = tile;
    s.seed = 1000 * static_cast<std::uint64_t>(tile) + 17;
    s.path_guiding = Guiding::off; // by default it depends on the samples
    if (change)
        change(s);
    return {std::move(name), s};
}

/// Returns variants of every method and shift, tiles of all kinds, and every option that changes sampling or
/// weights. Most variants switch adaptive tile splitting off: in these small pictures, it leaves many pixels
/// without reuse.
std::vector<Variant> all_variants() {
    using S = RenderSettings;
    return {
        variant("pt", Method::pt, 1),
        variant("pt, RR depth 2", Method::pt, 1, [](S& s) { s.roulette_depth = 2; }),
        variant("pt, path guiding, RR depth 1", Method::pt, 1,
                [](S& s) { s.path_guiding = Guiding::on, s.roulette_depth = 1; }),
        variant("pr, path guiding", Method::pr, 4, [](S& s) { s.path_guiding = Guiding::on; }),
        variant("pr, tiles whole", Method::pr, 4, [](S& s) { s.adapt_tile = false; }),
        variant("gpr, tiles whole", Method::gpr, 6, [](S& s) { s.adapt_tile = false; }),
        variant("gpt, path guiding", Method::gpt, 1, [](S& s) { s.path_guiding = Guiding::on; }),
        variant("gpr, path guiding", Method::gpr, 6, [](S& s) { s.path_guiding = Guiding::on; }),
        variant("gpr, path guiding, replay, tiles whole", Method::gpr, 3,
                [](S& s) { s.path_guiding = Guiding::on, s.shift = ShiftKind::replay, s.adapt_tile = false; }),
        variant("gpr, path guiding, replay-reconnection, tiles whole", Method::gpr, 4,
                [](S& s) {
                    s.path_guiding = Guiding::on, s.shift = ShiftKind::replay_reconnection, s.adapt_tile = false;
                }),
        variant("pr, absolute roulette, tiles whole", Method::pr, 4,
                [](S& s) { s.roulette = RouletteKind::absolute, s.adapt_tile = false; }),
        variant("pr, 5-rooks, reconnection", Method::pr, 5,
                [](S& s) { s.pattern = Pattern::rooks, s.shift = ShiftKind::reconnection; }),
        variant("pr, 8-rooks", Method::pr, 8, [](S& s) { s.pattern = Pattern::rooks; }),
        variant("pr, 4-rooks, replay, RR depth 2", Method::pr, 4,
                [](S& s) { s.pattern = Pattern::rooks, s.shift = ShiftKind::replay, s.roulette_depth = 2; }),
        variant("pr, reconnection, RR depth 2, tiles whole", Method::pr, 4,
                [](S& s) { s.shift = ShiftKind::reconnection, s.roulette_depth = 2, s.adapt_tile = false; }),
        variant("gpt, RR depth 1", Method::gpt, 1, [](S& s) { s.roulette_depth = 1; }),
        variant("gpt, replay, no basis", Method::gpt, 1,
                [](S& s) { s.shift = ShiftKind::replay, s.basis = Basis::none; }),
        variant("gpt, replay-reconnection", Method::gpt, 1,
                [](S& s) { s.shift = ShiftKind::replay_reconnection; }),
        variant("gpr", Method::gpr, 1),
        variant("gpr, absolute roulette, tiles whole", Method::gpr, 2,
                [](S& s) { s.roulette = RouletteKind::absolute, s.adapt_tile = false; }),
        variant("gpr, replay, tiles whole", Method::gpr, 3,
                [](S& s) { s.shift = ShiftKind::replay, s.adapt_tile = false; }),
        variant("gpr, tiles whole, no basis", Method::gpr, 6,
                [](S& s) { s.adapt_tile = false, s.basis = Basis::none; }),
        variant("gpr", Method::gpr, 6),
        variant(
            "gpr, replay-reconnection, RR depth 2, tiles whole", Method::gpr, 6,
            [](S& s) { s.shift = ShiftKind::replay_reconnection, s.roulette_depth = 2, s.adapt_tile = false; }),
        variant("gpr, reconnection, tiles whole", Method::gpr, 8,
                [](S& s) { s.shift = ShiftKind::reconnection, s.adapt_tile = false; }),
        variant("gpr, no roulette, RR depth 2", Method::gpr, 16,
                [](S& s) {
                    s.roulette = RouletteKind::none, s.adapt_tile = false;
                    s.roulette_depth = 2;
                }),
    };
}

/// Raises standard errors to at least the standard error of as many independent camera positions. Stratified
/// positions find the same fraction of an edge in nearly all runs, so the variance between runs misses the rare
/// others.
/// @param positions  camera positions a pass, summed over all runs
/// @param where      1: in these pixels; null: in all
Measured with_least_standard_error(Measured m, const Measured& truth, int positions,
                                   const Image<std::uint8_t>* where) {
    const auto scale = static_cast<float>(std::sqrt(static_cast<double>(naive_samples) / (passes * positions)));
    for (std::size_t i = 0; i < m.mean.size(); ++i)
        if (!where || where->data()[i])
            m.standard_error.data()[i] =
                glm::max(m.standard_error.data()[i], truth.standard_error.data()[i] * scale);
    return m;
}

/// Returns 1 for the pixels that are mixed (LearnedReuse::is_mixed) with any of 32 seeds.
Image<std::uint8_t> ever_mixed(const std::shared_ptr<const Scene>& scene, glm::ivec2 size,
                               RenderSettings settings) {
    Image<std::uint8_t> all(size.x, size.y);
    ThreadPool pool(1);
    for (settings.seed = 0; settings.seed < 32; ++settings.seed) {
        Render render(scene, scene->camera(), size, settings);
        render.pass(pool);
        const Image<std::uint8_t>& mixed = *render.newest_learned()->mixed();
        std::transform(all.begin(), all.end(), mixed.begin(), all.begin(), std::bit_or());
    }
    return all;
}

/// Returns one variant of each method and a quarter of the other variants, which depends on the scene's name. The
/// slow tests judge all variants on all scenes.
std::vector<Variant> variants_of(const std::string& scene) {
    constexpr std::string_view always[] = {"pt", "pr, absolute roulette, tiles whole", "gpt, RR depth 1", "gpr",
                                           "gpr, tiles whole"};
    std::vector<Variant> variants;
    std::size_t number = std::accumulate(scene.begin(), scene.end(), std::size_t{0});
    for (Variant& v : all_variants())
        if (std::ranges::count(always, v.name) > 0 || number++ % 4 == 0)
            variants.push_back(std::move(v));
    return variants;
}

class Judge : public testing::TestWithParam<TestScene> {
protected:
    void judge_all(glm::ivec2 size, const std::vector<Variant>& variants) {
        const TestScene& t = GetParam();
        const NaiveMeasured truth = render_naive(*t.scene, size, t.max_depth, naive_samples * t.effort, 1);
        for (const Variant& v : variants)
            judge(truth, v, size);
    }

    struct Test {
        std::string image;
        ZResult z;
    };

    void judge(const NaiveMeasured& truth, const Variant& v, glm::ivec2 size) {
        const auto tests_of_runs = [&](std::uint64_t seed, int count) {
            Variant of_seed = v;
            of_seed.settings.seed = seed;
            return tests_of(truth, of_seed, size, count);
        };
        for (const Test& t : tests_by_enough_runs(v.settings.seed, runs, tests_of_runs))
            EXPECT_TRUE(t.z.passes()) << GetParam().name << ' ' << v.name << " tile " << v.settings.tile << ' '
                                      << t.image << ": " << t.z.to_string();
    }

    std::vector<Test> tests_of(const NaiveMeasured& truth, Variant v, glm::ivec2 size, int count) {
        const TestScene& t = GetParam();
        v.settings.max_depth = t.max_depth;
        v.settings.shift_threshold = t.shift_threshold;
        v.settings.shift_distance = t.shift_distance;
        const MethodMeasured m = measure(t.scene, size, v.settings, count * t.effort, passes);
        const Image<std::uint8_t> mixed =
            has_positions(v.settings) ? ever_mixed(t.scene, size, v.settings) : Image<std::uint8_t>();
        const auto floored = [&](const Measured& measured) {
            return has_positions(v.settings)
                       ? with_least_standard_error(measured, truth.light, count * camera_positions(v.settings),
                                                   &mixed)
                       : measured;
        };
        std::vector<Test> tests;
        const auto add = [&](const std::string& image, const ZResult& z) {
            std::printf("  %-26s %-58s tile %2d, %3.0f %% of the pixels reuse paths, %4d runs %-11s %s\n",
                        t.name.c_str(), v.name.c_str(), v.settings.tile, 100 * m.sharing, count, image.c_str(),
                        z.to_string().c_str());
            tests.push_back({image, z});
        };
        add("primal", z_test(floored(m.primal), truth.light));
        add("very direct", z_test(with_least_standard_error(m.very_direct, truth.very_direct, count, nullptr),
                                  truth.very_direct));
        for (const auto& [norm, picture] : m.pictures)
            add("picture " + std::string(to_string(norm)),
                z_test(floored(picture), sum(truth.light, truth.very_direct)));
        if (!has_gradients(v.settings.method))
            return tests;
        const bool is_demodulated = v.settings.basis == Basis::albedo;
        if (is_demodulated)
            add("coefficient", z_test(m.coefficient, truth.coefficient));
        const Measured& primal = is_demodulated ? truth.coefficient : truth.light;
        add("dx", z_test(m.dx, difference_x(primal)));
        add("dy", z_test(m.dy, difference_y(primal)));
        return tests;
    }
};

TEST_P(Judge, AllMethodsAreUnbiased) {
    // In the small picture of the glass ball, all pixels are in one tile and share its rare bright paths.
    judge_all(GetParam().name == "glass" ? large : small, variants_of(GetParam().name));
}

TEST_P(Judge, SlowAllVariantsAreUnbiased) {
    judge_all(large, all_variants());
}

INSTANTIATE_TEST_SUITE_P(scenes, Judge, testing::ValuesIn(all_test_scenes()),
                         [](const auto& p) { return p.param.name; });

} // namespace

} // namespace tessera::test
