// Numbers that lie evenly over the passes: nets, what they spare, and that no pass goes by what tells of its own.
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

/// A floor under a lamp that the camera does not see, so near that its light comes from many directions.
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

/// In which of so many equal parts a pass' numbers for a pixel are: its position and what is drawn at x_1.
std::vector<int> parts_of(const Scene& scene, const RenderSettings& s, const LearnedReuse& learned, int pass,
                          int parts, int path = 0) {
    const Pass p(scene, scene.camera(), size, s, learned, pass);
    std::vector<glm::vec2> numbers{p.camera_sample({5, 7}, path).subpixel};
    for (const Draw purpose :
         {Draw::emitter, Draw::emitter_position, Draw::emitter_cell, Draw::lobe, Draw::direction})
        numbers.push_back(p.random(5, 7, path).draw_2d(1, purpose));
    std::vector<int> result;
    for (const glm::vec2 n : numbers)
        for (const float a : {n.x, n.y})
            result.push_back(static_cast<int>(a * static_cast<float>(parts)));
    return result;
}

constexpr std::size_t positions = 2, all_numbers = 12;

/// How many of the numbers lie evenly: in each of as many parts as there are passes.
int count_even(const Scene& scene, const RenderSettings& s, const LearnedReuse& learned, int from, int to,
               int path = 0) {
    std::array<std::set<int>, all_numbers> parts;
    for (int pass = from; pass < to; ++pass) {
        const std::vector<int> found = parts_of(scene, s, learned, pass, to - from, path);
        for (std::size_t i = 0; i < found.size(); ++i)
            parts[i].insert(found[i]);
    }
    return static_cast<int>(std::ranges::count_if(
        parts, [&](const std::set<int>& p) { return static_cast<int>(p.size()) == to - from; }));
}

/// The mean of so many renders of one pass each, of other seeds; or one render of as many passes.
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

TEST(Nets, OfTwoKeysHaveNothingToDoWithEachOther) {
    constexpr std::uint32_t count = 256;
    for (std::uint64_t key = 0; key < 64; key += 2)
        for (const int digit : {31, 63}) {
            int alike = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                alike += ((net_point(i, key) ^ net_point(i, key + 1)) >> digit & 1) == 0;
            EXPECT_NEAR(alike, count / 2, 5 * std::sqrt(count) / 2) << "key " << key;
        }
}

TEST(Nets, GoOverPassesUntilThereAreTwiceAsMany) {
    const auto scene = lit_floor();
    for (const Method method : {Method::pt, Method::gpt})
        for (const int path : {0, 3}) {
            LearnedReuse learned(size, settings_of(method));
            learned.take(LearnedReuse(size, settings_of(method)), 4);
            EXPECT_EQ(learned.first_pass(), 0); // nothing was learnt, as nothing can be
            EXPECT_EQ(count_even(*scene, settings_of(method), learned, 32, 64, path), all_numbers);
            EXPECT_LT(count_even(*scene, settings_of(method), learned, 0, 64, path), all_numbers);
        }
}

/// So that parts of a picture that are rendered by themselves have the numbers that they have in the whole.
TEST(Nets, BeginWhetherOrNotThereIsSomethingToLearn) {
    const auto scene = lit_floor();
    RenderSettings guided = settings_of(Method::pt);
    guided.path_guiding = Guiding::where_it_pays;
    LearnedReuse learnt(size, guided);
    learnt.take(LearnedReuse(size, guided), 8);
    EXPECT_EQ(learnt.first_pass(), 8);
    for (const int pass : {8, 9, 15})
        EXPECT_EQ(
            parts_of(*scene, guided, learnt, pass, 4096),
            parts_of(*scene, settings_of(Method::pt), LearnedReuse(size, settings_of(Method::pt)), pass, 4096));
}

TEST(Nets, AreAnewWherePassesGoByWhatOthersFound) {
    const auto scene = lit_floor();
    int even_over_both = 0, repeated = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const RenderSettings s = settings_of(Method::gpr, seed);
        const LearnedReuse before(size, s); // whose net begins with pass 8
        LearnedReuse learned(size, s);
        learned.take(before, 12); // in a render that began with pass 8
        EXPECT_EQ(learned.first_pass(), 12);
        EXPECT_EQ(count_even(*scene, s, learned, 12, 16), all_numbers);
        std::array<std::set<int>, all_numbers> quarters; // all four of one net, if no other had begun
        for (const int pass : {12, 13, 14, 15}) {
            const std::vector<int> found = parts_of(*scene, s, pass < 14 ? before : learned, pass, 4);
            for (std::size_t i = 0; i < found.size(); ++i)
                quarters[i].insert(found[i]);
        }
        const auto first = parts_of(*scene, s, learned, 12, 1024), of_last = parts_of(*scene, s, before, 8, 1024);
        for (std::size_t i = positions; i < all_numbers; ++i) {
            even_over_both += quarters[i].size() == 4;
            repeated += first[i] == of_last[i];
        }
    }
    EXPECT_NEAR(even_over_both, 40, 30); // of 160: a quarter, by chance
    EXPECT_LT(repeated, 5);
}

TEST(Nets, OfPixelsAndPathsDiffer) {
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

/// A pixel has the same samples in a wider image, so that a crop can be compared with the whole.
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

/// What pixels share, and smoothing takes together.
TEST(Nets, SpareNoiseOfMeansOverPixels) {
    const auto scene = lit_floor();
    const auto means = [&](const RgbImage& image) { // of 4x4 pixels
        RgbImage result(size.x, size.y, Rgb(0));
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                result(x / 4, y / 4) += image(x, y) / 16.0f;
        return result;
    };
    double of_pixels = 0, of_means = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const RgbImage a = picture(scene, 1, 1, seed), b = picture(scene, 1, 1, 1000 + seed);
        of_pixels += squared_difference(a, b);
        of_means += squared_difference(means(a), means(b));
    }
    // Were they independent, means would have a 16th of the variance; and they are a 16th as many. (Squares of 4x4
    // pixels lie anywhere beside those that are nets.)
    EXPECT_LT(of_means, 0.75 * of_pixels / (16 * 16));
}

TEST(Nets, RendersChangePlansWhenTheyHaveTwiceAsManyPasses) {
    const auto scene = lit_floor();
    ThreadPool pool(1);
    RenderSettings guided = settings_of(Method::pt);
    guided.path_guiding = Guiding::where_it_pays;
    for (const RenderSettings& s : {settings_of(Method::gpr), guided}) {
        Render render(scene, scene->camera(), size, s);
        for (const int first : {0, 1, 2, 2, 4, 4, 4, 4, 8}) {
            render.pass(pool);
            EXPECT_EQ(render.newest_learned()->first_pass(), first);
        }
    }
}

TEST(Nets, SpareNoise) {
    const auto scene = lit_floor();
    constexpr int passes = 32;
    const double evenly = squared_difference(picture(scene, passes, 1, 0), picture(scene, passes, 1, 1000));
    const double alone = squared_difference(picture(scene, 1, passes, 0), picture(scene, 1, passes, 1000));
    EXPECT_LT(evenly, 0.7 * alone);
}

} // namespace tessera::test
