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
Image<PlanEvidence> luminance(int n, float scale = 1) {
    Image<PlanEvidence> image(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image(x, y).luminance = x >= size.x / 2 || (y * size.x + x) % n == 0 ? scale : 0;
    return image;
}

constexpr PixelRect left{2, 2, 8, 8}, right{50, 2, 56, 8};

TEST(ReusePlan, WithoutAPassGprSharesInSmallSquaresAndPrInWholeTiles) {
    EXPECT_EQ(ReusePlan(size, settings_of()).part_edge(left), 2);
    EXPECT_EQ(ReusePlan(size, settings_of()).paths_alone(left), 0);
    EXPECT_EQ(ReusePlan(size, settings_of(Method::pr)).part_edge(left), 6);
}

/// Paths that bring very different light: lengths of gradients are `shared` with sharing, and 1 without.
Image<PlanEvidence> steps(float shared, float offset_rays) {
    Image<PlanEvidence> image = luminance(1000);
    for (PlanEvidence& e : image) {
        e.luminance = e.luminance > 0 ? 1000.0f : 0.001f;
        e = {e.luminance, 2 * shared, 2, offset_rays, 8};
    }
    return image;
}

TEST(ReusePlan, PixelsAreAloneWhereGradientsTellNothingForTheirCost) {
    const auto paths_alone = [](float shared, float offset_rays, Method method = Method::gpr) {
        ReusePlan plan(size, settings_of(method));
        plan.learn(steps(shared, offset_rays));
        EXPECT_EQ(plan.part_edge(left), 6);
        return plan.paths_alone(left);
    };
    EXPECT_EQ(paths_alone(0.1f, 1.5f), 0); // 65 offsets a pixel: 12 rays of offsets to one of a base path
    EXPECT_EQ(paths_alone(0.4f, 0.1f), 0);
    EXPECT_EQ(paths_alone(0.6f, 1.5f), 6); // what sharing would have cost
    EXPECT_EQ(paths_alone(1, 1000), 12);
    EXPECT_EQ(paths_alone(0.6f, 1.5f, Method::pr), 0); // it has no gradients
}

TEST(ReusePlan, WhatTheFirstPassFoundStays) {
    ReusePlan plan(size, settings_of());
    plan.learn(steps(0.6f, 1.5f));
    for (int pass = 1; pass < 10; ++pass)
        plan.learn(luminance(1000, 1000));
    EXPECT_EQ(plan.paths_alone(left), 6);
}

TEST(ReusePlan, WithoutLightPixelsShare) {
    ReusePlan plan(size, settings_of());
    plan.learn(Image<PlanEvidence>(size.x, size.y, {0, 0, 0, 0, 8}));
    EXPECT_EQ(plan.paths_alone(left), 0);
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
