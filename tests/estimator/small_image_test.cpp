// Z-tests against the naive path tracer for images smaller than tiles and patterns: sampling sets that are cut off
// on all sides, and pixels without neighbours.
#include "tests/support/scene_builder.h"
#include "tests/support/z_scores.h"

#include <stdexcept>
#include <string_view>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int naive_samples = 65536;
constexpr int runs = 32;

struct Case {
    const char* scene;
    glm::ivec2 size;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.scene << ' ' << c.size.x << 'x' << c.size.y;
}

TestScene scene_named(std::string_view name) {
    for (TestScene& t : all_test_scenes())
        if (t.name == name)
            return t;
    throw std::runtime_error("no such scene");
}

class SmallImage : public testing::TestWithParam<Case> {};

TEST_P(SmallImage, AllMethodsAreUnbiased) {
    const TestScene t = scene_named(GetParam().scene);
    const glm::ivec2 size = GetParam().size;
    const NaiveMeasured truth = render_naive(*t.scene, size, t.max_depth, naive_samples, 3);
    const int passes = 512 / (size.x * size.y) + 16; // similar numbers of paths for all sizes
    for (const Method method : all_methods)
        for (const int tile : {1, 6, 16})
            for (const Pattern pattern : {Pattern::tile, Pattern::rooks}) {
                if (method != Method::pr && pattern == Pattern::rooks)
                    continue;
                RenderSettings s;
                s.method = method;
                s.tile = tile;
                s.pattern = pattern;
                s.max_depth = t.max_depth;
                s.shift_threshold = t.shift_threshold;
                s.shift_distance = t.shift_distance;
                s.seed = 500;
                const MethodMeasured m = measure(t.scene, size, s, runs, passes);
                const std::string name = std::string(short_name(method)) + " tile " + std::to_string(tile) +
                                         (pattern == Pattern::rooks ? " rooks " : " ");
                const auto test_image = [&](const char* image, const Measured& measured,
                                            const Measured& expected) {
                    const ZResult z = z_test(measured, expected);
                    EXPECT_TRUE(z.passes()) << name << image << ": " << z.to_string();
                };
                test_image("primal", m.primal, truth.light);
                if (has_gradients(method)) {
                    test_image("dx", m.dx, difference_x(truth.coefficient));
                    test_image("dy", m.dy, difference_y(truth.coefficient));
                }
            }
}

INSTANTIATE_TEST_SUITE_P(cases, SmallImage,
                         testing::Values(Case{"diffuse", {1, 1}}, Case{"diffuse", {5, 3}},
                                         Case{"rough_glass_half_vectors", {1, 1}},
                                         Case{"rough_glass_half_vectors", {5, 3}}),
                         [](const auto& p) {
                             return std::string(p.param.scene) + "_" + std::to_string(p.param.size.x) + "x" +
                                    std::to_string(p.param.size.y);
                         });

} // namespace

} // namespace tessera::test
