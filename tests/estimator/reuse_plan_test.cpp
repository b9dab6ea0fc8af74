#include "render/estimator/reuse_policy.h"

#include <initializer_list>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(64, 32);

RenderSettings settings_of(Method method = Method::gpr, int tile = 6) {
    RenderSettings s;
    s.method = method;
    s.tile = tile;
    return s;
}

/// Base paths of which every n-th is lit, in the left half of the image; those in the right half all are.
Image<float> luminance(int n, float scale = 1) {
    Image<float> image(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image(x, y) = x >= size.x / 2 || (y * size.x + x) % n == 0 ? scale : 0;
    return image;
}

constexpr PixelRect left{2, 2, 8, 8}, right{50, 2, 56, 8};

TEST(ReusePlan, WithoutAPassTilesStayWhole) {
    const ReusePlan plan(size, settings_of());
    EXPECT_EQ(plan.part_edge(left), 6);
}

TEST(ReusePlan, CutsWherePathsBringAlike) {
    ReusePlan plan(size, settings_of());
    plan.learn(luminance(10));
    EXPECT_EQ(plan.part_edge(left), 6); // V = 9, l = 0.1
    EXPECT_EQ(plan.part_edge(right), 1);
}

TEST(ReusePlan, TheUnitOfLightDoesNotMatter) {
    for (float scale : {1e-20f, 1e-3f, 1e3f, 1e20f})
        for (int n : {2, 3, 5, 100}) {
            ReusePlan plan(size, settings_of(Method::pr, 16)), scaled(size, settings_of(Method::pr, 16));
            plan.learn(luminance(n));
            scaled.learn(luminance(n, scale));
            EXPECT_EQ(plan.part_edge(left), scaled.part_edge(left)) << scale << ' ' << n;
        }
}

TEST(ReusePlan, PartsFillEveryTileWhateverItsEdge) {
    for (int tile = 1; tile <= 16; ++tile)
        for (int n : {1, 2, 3, 4, 8, 64, 4096}) {
            ReusePlan plan(size, settings_of(Method::gpr, tile));
            plan.learn(luminance(n));
            // Tiles beyond the image's borders are cut, too.
            for (PixelRect r : {left, right, PixelRect{-5, -5, 1, 1}, PixelRect{63, 31, 69, 37}}) {
                EXPECT_GE(plan.part_edge(r), 1) << tile << ' ' << n;
                EXPECT_LE(plan.part_edge(r), tile) << tile << ' ' << n;
            }
        }
}

TEST(ReusePlan, CanBeSwitchedOff) {
    RenderSettings s = settings_of();
    s.adapt_tile = false;
    ReusePlan plan(size, s);
    plan.learn(luminance(10));
    EXPECT_EQ(plan.part_edge(right), 6);
}

TEST(Squares, FillARectangleOnce) {
    Image<int> hits(16, 16);
    for_each_square({-1, 2, 6, 5}, 3, [&](PixelRect r) {
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x)
                ++hits(x + 4, y + 4);
    });
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(hits(x, y), x - 4 >= -1 && x - 4 < 6 && y - 4 >= 2 && y - 4 < 5);
}

} // namespace

} // namespace tessera::test
