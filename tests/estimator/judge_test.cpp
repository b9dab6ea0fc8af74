// Every method against the naive judge, on every small scene: primal and gradients, borders and odd tiles
// included.
#include "tests/support/scene_builder.h"
#include "tests/support/z_scores.h"

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(13, 9); // not a multiple of any tile
constexpr int naive_samples = 32768;
constexpr int runs = 48;
constexpr int passes = 16;

class Judge : public testing::TestWithParam<TestScene> {
protected:
    void judge(const Measured& truth, Method method, int tile) {
        const TestScene& t = GetParam();
        RenderSettings s;
        s.method = method;
        s.max_depth = t.max_depth;
        s.tile = tile;
        s.shift_threshold = t.shift_threshold;
        s.seed = 1000 * static_cast<std::uint64_t>(tile) + 17;
        const MethodMeasured m = measure(t.scene, size, s, runs * t.effort, passes);
        report("primal", method, tile, z_test(m.primal, truth));
        if (has_gradients(method)) {
            report("dx", method, tile, z_test(m.dx, difference_x(truth)));
            report("dy", method, tile, z_test(m.dy, difference_y(truth)));
        }
    }

    void report(const char* what, Method method, int tile, const ZResult& z) {
        std::printf("  %-26s %-3s tile %2d %-6s %s\n", GetParam().name.c_str(), short_name(method).data(), tile,
                    what, z.to_string().c_str());
        EXPECT_TRUE(z.passes()) << GetParam().name << ' ' << short_name(method) << " tile " << tile << ' ' << what
                                << ": " << z.to_string();
    }
};

TEST_P(Judge, AllMethods) {
    const TestScene& t = GetParam();
    const Measured truth = render_naive(*t.scene, size, t.max_depth, naive_samples * t.effort, 1);
    judge(truth, Method::pt, 1);
    judge(truth, Method::pr, 4);
    judge(truth, Method::gpt, 1);
    for (int tile : {1, 2, 6, 16})
        judge(truth, Method::gpr, tile);
}

INSTANTIATE_TEST_SUITE_P(scenes, Judge, testing::ValuesIn(all_test_scenes()),
                         [](const auto& p) { return p.param.name; });

} // namespace

} // namespace tessera::test
