// Adaptive tile splitting, and the decision where pixels reuse no paths.
#include "render/estimator/learned_reuse.h"

#include <initializer_list>
#include <vector>

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

/// Returns luminances of base paths: every n-th path is lit in the left half of the image, all are in the right
/// half.
Image<float> luminance(int n, float scale = 1) {
    Image<float> image(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            image(x, y) = x >= size.x / 2 || (y * size.x + x) % n == 0 ? scale : 0;
    return image;
}

constexpr PixelRect left{2, 2, 8, 8}, right{50, 2, 56, 8}, between{12, 2, 18, 8};

TEST(LearnedReuse, TilesAreWholeAtFirst) {
    for (const Method method : {Method::pr, Method::gpr}) {
        EXPECT_EQ(LearnedReuse(size, settings_of(method)).split_edge(left), 6);
        EXPECT_EQ(LearnedReuse(size, settings_of(method)).paths_without_reuse(left), 0);
    }
}

/// Returns the statistics of a cell whose 1000 base paths take 8 rays each and have very different luminances.
/// @param rho          noise of gradients with path reuse over that without
/// @param offset_rays  rays of an offset path
/// @param lit          number of paths that carry light
CellStatistics statistics_of(double rho, double offset_rays, int lit = 1000) {
    CellStatistics e;
    for (int i = 0; i < 1000; ++i)
        e.add_path(i == 0 ? 1 : i < lit ? 1e-4 : 0);
    e.add_gradient_noise(rho, 1);
    e.offset_rays = 1000 * offset_rays;
    e.base_rays = 8000;
    return e;
}

/// Returns the state after a pilot pass with these statistics in the upper left cell. Elsewhere path reuse pays.
LearnedReuse after_pilot(const CellStatistics& upper_left, double offset_rays = 0.5) {
    LearnedReuse learned(size, settings_of());
    std::vector<CellStatistics> pilot(static_cast<std::size_t>(learned.cell_count()),
                                      statistics_of(0.1, offset_rays));
    pilot[0] = upper_left;
    learned.learn(pilot);
    return learned;
}

// With 0.5 rays an offset, a 6x6 tile has 65 offsets a pixel, and reuse costs 1.7 + 0.55 * 65 / 16 = 3.9 samples.

TEST(LearnedReuse, NoReuseWhereItCostsMoreThanItGains) {
    EXPECT_EQ(after_pilot(statistics_of(0.50, 0.5)).paths_without_reuse(left), 0);
    EXPECT_EQ(after_pilot(statistics_of(0.52, 0.5)).paths_without_reuse(left), 4);
    EXPECT_EQ(after_pilot(statistics_of(0.70, 0.01)).paths_without_reuse(left), 0);
    EXPECT_EQ(after_pilot(statistics_of(0.80, 0.01)).paths_without_reuse(left), 4);
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5)).paths_without_reuse(right), 0);
}

TEST(LearnedReuse, OneOutlierSetDoesNotSwitchReuseOff) {
    constexpr int sets = 8;
    const auto with_outliers = [](double outlier_noise, int outliers) {
        CellStatistics e = statistics_of(0, 0.5);
        e.reuse_noise = e.own_noise = 0;
        for (int i = 0; i < sets; ++i)
            e.add_gradient_noise(i < outliers ? outlier_noise : 0.1, i < outliers ? outlier_noise : 1);
        return e;
    };
    EXPECT_EQ(after_pilot(with_outliers(20, 1)).paths_without_reuse(left),
              0); // rho 0.45; plain sums would give 0.77
    EXPECT_EQ(after_pilot(with_outliers(20, 2)).paths_without_reuse(left), 4); // rho 0.64
}

TEST(LearnedReuse, IgnoresSetsWithoutNoiseOfTheirOwn) {
    CellStatistics e = statistics_of(0.1, 0.5);
    const double shared = e.reuse_noise, own = e.own_noise;
    e.add_gradient_noise(1, 0);
    EXPECT_EQ(e.reuse_noise, shared);
    EXPECT_EQ(e.own_noise, own);
}

TEST(LearnedReuse, PathsWithoutReuseMatchTheCostOfReuseElsewhere) {
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5), 0).paths_without_reuse(left), 2);
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5), 1).paths_without_reuse(left), 6);
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5), 4).paths_without_reuse(left), 12);
}

/// The rho of a cell with two lit paths may be chance. If all cells have that rho, it is not. One cell with a huge
/// rho does not decide for the others.
TEST(LearnedReuse, CellWithFewLitPathsFollowsTheOthers) {
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5, 2)).paths_without_reuse(left), 0);
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5, 20)).paths_without_reuse(left), 4);
    EXPECT_EQ(after_pilot(statistics_of(1, 0.5, 0)).paths_without_reuse(left), 0);
    EXPECT_EQ(after_pilot(statistics_of(1e6, 0.5)).paths_without_reuse(right), 0);
    LearnedReuse learned(size, settings_of());
    learned.learn(
        std::vector<CellStatistics>(static_cast<std::size_t>(learned.cell_count()), statistics_of(1, 0.5, 2)));
    EXPECT_GT(learned.paths_without_reuse(left), 0);
}

TEST(LearnedReuse, PilotDecidesForTheWholeRender) {
    LearnedReuse learned = after_pilot(statistics_of(1, 0.5));
    for (int pass = 0; pass < 10; ++pass)
        learned.learn(luminance(1000, 1000));
    EXPECT_EQ(learned.paths_without_reuse(left), 4);
    EXPECT_EQ(learned.split_edge(left), 6);
}

TEST(LearnedReuse, DarkCellsReusePaths) {
    CellStatistics dark;
    dark.paths = 100;
    dark.base_rays = 800;
    EXPECT_EQ(after_pilot(dark).paths_without_reuse(left), 0);
}

TEST(LearnedReuse, OnlyGprWantsAPilot) {
    EXPECT_TRUE(LearnedReuse(size, settings_of()).wants_pilot());
    EXPECT_FALSE(LearnedReuse(size, settings_of(Method::gpr, 1)).wants_pilot());
    EXPECT_FALSE(LearnedReuse(size, settings_of(Method::pr)).wants_pilot()); // it has no gradients
}

std::vector<PixelRect> pieces_of(const LearnedReuse& learned, PixelRect tile) {
    std::vector<PixelRect> pieces;
    learned.for_each_piece(tile, [&](PixelRect piece) { pieces.push_back(piece); });
    return pieces;
}

TEST(LearnedReuse, CutsTilesAlongTheBorderOfReuse) {
    const LearnedReuse learned =
        after_pilot(statistics_of(1, 0.5)); // the upper left cell ends at column and row 16
    EXPECT_EQ(pieces_of(learned, left), std::vector{left});
    EXPECT_EQ(pieces_of(learned, right), std::vector{right});
    EXPECT_EQ(pieces_of(learned, between), (std::vector<PixelRect>{{12, 2, 16, 8}, {16, 2, 18, 8}}));
    EXPECT_EQ(pieces_of(learned, {12, 13, 18, 19}),
              (std::vector<PixelRect>{{12, 13, 16, 16}, {16, 13, 18, 16}, {12, 16, 16, 19}, {16, 16, 18, 19}}));
    EXPECT_EQ(pieces_of(learned, {-3, 12, 3, 18}), (std::vector<PixelRect>{{-3, 12, 3, 16}, {-3, 16, 3, 18}}));
    EXPECT_EQ(learned.paths_without_reuse({12, 2, 16, 8}), 4);
    EXPECT_EQ(learned.paths_without_reuse({16, 2, 18, 8}), 0);
    EXPECT_EQ(pieces_of(after_pilot(statistics_of(0, 0.5)), between),
              std::vector{between}); // all pixels reuse paths
}

TEST(LearnedReuse, SplitsTilesWherePathsHaveEqualRadiance) {
    LearnedReuse learned(size, settings_of());
    learned.learn(luminance(10));
    EXPECT_EQ(learned.split_edge(left), 6); // V = 9, l = 0.1
    EXPECT_EQ(learned.split_edge(right), 1);
}

TEST(LearnedReuse, IsIndependentOfTheUnitOfRadiance) {
    for (float scale : {1e-20f, 1e-3f, 1e3f, 1e20f})
        for (int n : {2, 3, 5, 100}) {
            LearnedReuse learned(size, settings_of(Method::pr, 16)), scaled(size, settings_of(Method::pr, 16));
            learned.learn(luminance(n));
            scaled.learn(luminance(n, scale));
            EXPECT_EQ(learned.split_edge(left), scaled.split_edge(left)) << scale << ' ' << n;
        }
}

TEST(LearnedReuse, SplitEdgeIsFromOneToTheEdgeOfTheTile) {
    for (int tile = 1; tile <= 16; ++tile)
        for (int n : {1, 2, 3, 4, 8, 64, 4096}) {
            LearnedReuse learned(size, settings_of(Method::gpr, tile));
            learned.learn(luminance(n));
            // Also for tiles that cross the image's borders.
            for (PixelRect r : {left, right, PixelRect{-5, -5, 1, 1}, PixelRect{63, 31, 69, 37}}) {
                EXPECT_GE(learned.split_edge(r), 1) << tile << ' ' << n;
                EXPECT_LE(learned.split_edge(r), tile) << tile << ' ' << n;
            }
        }
}

TEST(LearnedReuse, CanBeSwitchedOff) {
    RenderSettings s = settings_of();
    s.adapt_tile = false;
    LearnedReuse learned(size, s);
    learned.learn(luminance(10));
    EXPECT_EQ(learned.split_edge(right), 6);
}

TEST(Squares, CoverARectangleOnce) {
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
