// Nets over the passes: their stratification, the noise that they save, and that they begin again after learning,
// so that no pass depends on what earlier points of its own nets decided.
#include "render/estimator/pass.h"
#include "render/run/render.h"
#include "render/sampling/random.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(32, 24);

/// Returns a scene of a floor under a near lamp, which the camera does not see and which lights it from many
/// directions.
std::shared_ptr<const Scene> lit_floor() {
    SceneBuilder b;
    b.quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, b.diffuse(Rgb(0.5f)));
    b.quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, b.diffuse(Rgb(0)), b.light(Texture(Rgb(3))));
    b.camera({0, 0.8f, 4}, {0, 0, 1}, 40);
    return b.build();
}

RenderSettings settings_of(Method method, std::uint64_t seed = 0) {
    RenderSettings s;
    s.method = method;
    s.max_depth = 2;
    s.path_guiding = Guiding::off;
    s.seed = seed;
    return s;
}

/// Returns the strata, of `count` equal intervals, of a pass' numbers for one pixel: its position and the numbers
/// drawn at x_1.
std::vector<int> strata_of(const Scene& scene, const RenderSettings& s, const LearnedReuse& learned, int pass,
                           int count, int path = 0) {
    const Pass p(scene, scene.camera(), size, s, learned, pass);
    std::vector<glm::vec2> numbers{p.camera_sample({5, 7}, path).subpixel};
    for (const Draw purpose :
         {Draw::emitter, Draw::emitter_position, Draw::emitter_cell, Draw::lobe, Draw::direction})
        numbers.push_back(p.random(5, 7, path).draw_2d(1, purpose));
    std::vector<int> result;
    for (const glm::vec2 n : numbers)
        for (const float a : {n.x, n.y})
            result.push_back(static_cast<int>(a * static_cast<float>(count)));
    return result;
}

constexpr std::size_t positions = 2, all_numbers = 12;

/// Returns how many of the numbers are stratified: over n passes, each of n strata has one.
int count_stratified(const Scene& scene, const RenderSettings& s, const LearnedReuse& learned, int from, int to,
                     int path = 0) {
    std::array<std::set<int>, all_numbers> strata;
    for (int pass = from; pass < to; ++pass) {
        const std::vector<int> found = strata_of(scene, s, learned, pass, to - from, path);
        for (std::size_t i = 0; i < found.size(); ++i)
            strata[i].insert(found[i]);
    }
    return static_cast<int>(std::ranges::count_if(
        strata, [&](const std::set<int>& stratum) { return static_cast<int>(stratum.size()) == to - from; }));
}

/// Returns the mean of renders with different seeds and so many passes each.
RgbImage picture(const std::shared_ptr<const Scene>& scene, int passes, int renders, std::uint64_t seed) {
    ThreadPool pool(1);
    RgbImage mean(size.x, size.y);
    for (int r = 0; r < renders; ++r) {
        Render render(scene, scene->camera(), size, settings_of(Method::pt, seed + static_cast<std::uint64_t>(r)));
        for (int i = 0; i < passes; ++i)
            render.pass(pool);
        const GradientImages images = render.images();
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                mean(x, y) += images.primal(x, y) / static_cast<float>(renders);
    }
    return mean;
}

double squared_difference(const RgbImage& a, const RgbImage& b) {
    double sum = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            sum += std::pow(static_cast<double>(luminance(a(x, y)) - luminance(b(x, y))), 2);
    return sum;
}

} // namespace

TEST(Nets, HaveOnePointInEachRectangleOfAnyShape) {
    for (const std::uint64_t key : {0u, 1u, 77u, 4000000000u})
        for (const std::uint64_t shift : {std::uint64_t{0}, Random(3, 4, 5).digits(1, Draw::lobe)})
            for (int n = 0; n <= 8; ++n)
                for (int wide = 0; wide <= n; ++wide) {
                    std::set<std::pair<std::uint64_t, std::uint64_t>> rectangles;
                    for (std::uint32_t i = 0; i < 1u << n; ++i) {
                        const std::uint64_t p = net_point((3u << n) + i, key) ^ shift;
                        rectangles.emplace((p >> 32) >> (32 - wide), (p & 0xffffffffu) >> (32 - (n - wide)));
                    }
                    EXPECT_EQ(rectangles.size(), 1u << n) << "key " << key << ", 2^" << wide << " columns";
                }
}

TEST(Nets, OfTwoKeysAreUncorrelated) {
    constexpr std::uint32_t count = 256;
    for (std::uint64_t key = 0; key < 64; key += 2)
        for (const int digit : {31, 63}) {
            int equal_digits = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                equal_digits += ((net_point(i, key) ^ net_point(i, key + 1)) >> digit & 1) == 0;
            EXPECT_NEAR(equal_digits, count / 2, 5 * std::sqrt(count) / 2) << "key " << key;
        }
}

TEST(Nets, SpanPassesBetweenPowersOfTwo) {
    const auto scene = lit_floor();
    for (const Method method : {Method::pt, Method::gpt})
        for (const int path : {0, 3}) {
            LearnedReuse learned(size, settings_of(method));
            learned.take(LearnedReuse(size, settings_of(method)), 4);
            EXPECT_EQ(learned.first_pass(), 0); // with these settings passes teach nothing
            EXPECT_EQ(count_stratified(*scene, settings_of(method), learned, 32, 64, path), all_numbers);
            EXPECT_LT(count_stratified(*scene, settings_of(method), learned, 0, 64, path), all_numbers);
        }
}

/// A picture is the same with and without guides to learn, as long as these draw nothing.
TEST(Nets, BeginAtTheSamePassesWithAndWithoutGuides) {
    const auto scene = lit_floor();
    RenderSettings guided = settings_of(Method::pt);
    guided.path_guiding = Guiding::automatic;
    LearnedReuse learned(size, guided);
    learned.take(LearnedReuse(size, guided), 8);
    EXPECT_EQ(learned.first_pass(), 8);
    for (const int pass : {8, 9, 15})
        EXPECT_EQ(
            strata_of(*scene, guided, learned, pass, 4096),
            strata_of(*scene, settings_of(Method::pt), LearnedReuse(size, settings_of(Method::pt)), pass, 4096));
}

TEST(Nets, BeginAgainAfterLearning) {
    const auto scene = lit_floor();
    int stratified_over_both = 0, repeated = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const RenderSettings s = settings_of(Method::gpr, seed);
        const LearnedReuse before(size, s); // its nets begin with pass 8
        LearnedReuse learned(size, s);
        learned.take(before, 12);
        EXPECT_EQ(learned.first_pass(), 12);
        EXPECT_EQ(count_stratified(*scene, s, learned, 12, 16), all_numbers);
        std::array<std::set<int>, all_numbers> quarters; // one net would have all four
        for (const int pass : {12, 13, 14, 15}) {
            const std::vector<int> found = strata_of(*scene, s, pass < 14 ? before : learned, pass, 4);
            for (std::size_t i = 0; i < found.size(); ++i)
                quarters[i].insert(found[i]);
        }
        const auto first = strata_of(*scene, s, learned, 12, 1024),
                   first_before = strata_of(*scene, s, before, 8, 1024);
        for (std::size_t i = positions; i < all_numbers; ++i) {
            stratified_over_both += quarters[i].size() == 4;
            repeated += first[i] == first_before[i];
        }
    }
    EXPECT_NEAR(stratified_over_both, 40, 30); // of 160; a quarter is expected
    EXPECT_LT(repeated, 5);
}

TEST(Nets, DifferBetweenPixelsAndPaths) {
    const auto scene = lit_floor();
    const RenderSettings s = settings_of(Method::pt);
    const Pass pass(*scene, scene->camera(), size, s, LearnedReuse(size, s), 3);
    std::set<float> positions_seen, directions_seen;
    for (int x = 0; x < 20; ++x)
        for (const int path : {0, 1, 2}) {
            positions_seen.insert(pass.camera_sample({x, 5}, path).subpixel.x);
            directions_seen.insert(pass.random(x, 5, path).draw(1, Draw::direction));
        }
    EXPECT_EQ(positions_seen.size(), 60u);
    EXPECT_EQ(directions_seen.size(), 60u);
}

/// A pixel has the same samples in a wider image, so a crop is comparable with the whole.
TEST(Nets, DoNotDependOnTheSizeOfTheImage) {
    const std::shared_ptr<const Scene> scene = lit_floor();
    const glm::ivec2 wide(size.x + 7, size.y + 3);
    for (const Method method : {Method::pt, Method::gpr}) {
        const RenderSettings s = settings_of(method);
        const LearnedReuse learned(size, s), wide_learned(wide, s);
        for (int pass = 0; pass < 3; ++pass) {
            const Pass a(*scene, scene->camera(), size, s, learned, pass),
                b(*scene, scene->camera(), wide, s, wide_learned, pass);
            EXPECT_EQ(a.camera_sample({5, 7}).subpixel, b.camera_sample({5, 7}).subpixel);
            for (int vertex = 1; vertex < 4; ++vertex)
                EXPECT_EQ(a.random(5, 7).digits(vertex, Draw::lobe), b.random(5, 7).digits(vertex, Draw::lobe));
        }
    }
}

/// Path reuse and filters average over squares of pixels.
TEST(Nets, ReduceTheNoiseOfMeansOverPixels) {
    const auto scene = lit_floor();
    const auto means = [&](const RgbImage& image) { // of 4x4 pixels
        RgbImage result(size.x, size.y, Rgb(0));
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                result(x / 4, y / 4) += image(x, y) / 16.0f;
        return result;
    };
    double pixel_error = 0, mean_error = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const RgbImage a = picture(scene, 1, 1, seed), b = picture(scene, 1, 1, 1000 + seed);
        pixel_error += squared_difference(a, b);
        mean_error += squared_difference(means(a), means(b));
    }
    // Means of independent pixels would have a 16th of the variance, and there are a 16th as many. The squares are
    // not aligned with the blocks of the nets.
    EXPECT_LT(mean_error, 0.75 * pixel_error / (16 * 16));
}

TEST(Nets, RendersLearnAtPowersOfTwo) {
    const auto scene = lit_floor();
    ThreadPool pool(1);
    RenderSettings guided = settings_of(Method::pt);
    guided.path_guiding = Guiding::automatic;
    for (const RenderSettings& s : {settings_of(Method::gpr), guided}) {
        Render render(scene, scene->camera(), size, s);
        for (const int first : {0, 1, 2, 2, 4, 4, 4, 4, 8}) {
            render.pass(pool);
            EXPECT_EQ(render.newest_learned()->first_pass(), first);
        }
    }
}

TEST(Nets, ReduceNoise) {
    const auto scene = lit_floor();
    constexpr int passes = 32;
    const double stratified = squared_difference(picture(scene, passes, 1, 0), picture(scene, passes, 1, 1000));
    const double independent = squared_difference(picture(scene, 1, passes, 0), picture(scene, 1, passes, 1000));
    EXPECT_LT(stratified, 0.7 * independent);
}

} // namespace tessera::test
