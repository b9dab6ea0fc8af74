// Nets over the pixels of blocks: the numbers drawn at x_1 are stratified over pixels in each pass.
#include "render/estimator/pass.h"
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

std::shared_ptr<const Scene> floor() {
    SceneBuilder b;
    b.quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, b.diffuse(Rgb(0.5f)));
    b.camera({0, 0.8f, 4}, {0, 0, 1}, 40);
    return b.build();
}

RenderSettings settings_of(Method method) {
    RenderSettings s;
    s.method = method;
    s.path_guiding = Guiding::off;
    return s;
}

constexpr std::array at_x1 = {Draw::emitter, Draw::emitter_position, Draw::emitter_cell, Draw::lobe,
                              Draw::direction};
constexpr int block_edge = 16; // pixels

/// Returns the index of the rectangle, of parts.x x parts.y in [0, 1)^2, that holds a pixel's number at x_1.
int rectangle_of(const Pass& pass, glm::ivec2 pixel, Draw purpose, glm::ivec2 parts, int path = 0) {
    const glm::ivec2 place(pass.random(pixel.x, pixel.y, path).draw_2d(1, purpose) * glm::vec2(parts));
    return place.y * parts.x + place.x;
}

/// Returns whether the numbers of the pixels occupy every one of parts.x x parts.y rectangles.
bool is_net(const Pass& pass, glm::ivec2 corner, glm::ivec2 pixels, Draw purpose, glm::ivec2 parts, int path = 0) {
    std::set<int> found;
    for (int y = 0; y < pixels.y; ++y)
        for (int x = 0; x < pixels.x; ++x)
            found.insert(rectangle_of(pass, corner + glm::ivec2(x, y), purpose, parts, path));
    return static_cast<int>(found.size()) == parts.x * parts.y;
}

/// Returns the corner of the first whole block of a picture that has at least two blocks along each axis.
glm::ivec2 first_block(const Pass& pass, int path = 0) {
    std::vector<glm::ivec2> corners;
    for (int y = 0; y < block_edge; ++y)
        for (int x = 0; x < block_edge; ++x)
            if (std::ranges::all_of(at_x1, [&](Draw purpose) {
                    return is_net(pass, {x, y}, {block_edge, block_edge}, purpose, {block_edge, block_edge}, path);
                }))
                corners.emplace_back(x, y);
    EXPECT_EQ(corners.size(), 1u);
    return corners.empty() ? glm::ivec2(0) : corners[0];
}

} // namespace

TEST(BlockNets, StratifyThePixelsOfABlockInEachPass) {
    const auto scene = floor();
    constexpr glm::ivec2 large(4 * block_edge);
    const RenderSettings s = settings_of(Method::gpr);
    for (const int index : {0, 5})
        for (const int path : {0, 2}) {
            const Pass pass(*scene, scene->camera(), large, s, LearnedReuse(large, s), index);
            const glm::ivec2 corner = first_block(pass, path);
            for (const Draw purpose : at_x1) {
                for (int wide = 1; wide <= block_edge * block_edge; wide *= 2) // elementary intervals
                    EXPECT_TRUE(is_net(pass, corner + block_edge, {block_edge, block_edge}, purpose,
                                       {wide, block_edge * block_edge / wide}, path));
                for (int part = 2; part < block_edge; part *= 2)
                    for (int j = 0; j < block_edge; j += part)
                        for (int i = 0; i < block_edge; i += part)
                            EXPECT_TRUE(is_net(pass, corner + glm::ivec2(i, j), {part, part}, purpose,
                                               {part, part}, path));
            }
        }
}

/// Otherwise all blocks would repeat the same pattern of errors.
TEST(BlockNets, DifferBetweenBlocksAndPurposes) {
    const auto scene = floor();
    constexpr int blocks = 12;
    constexpr glm::ivec2 large((blocks + 1) * block_edge), cells(block_edge);
    const RenderSettings s = settings_of(Method::gpr);
    const Pass pass(*scene, scene->camera(), large, s, LearnedReuse(large, s), 3);
    const glm::ivec2 first = first_block(pass);
    std::set<int> numbers, steps, relations;
    for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < blocks; ++x) {
            const glm::ivec2 corner = first + block_edge * glm::ivec2(x, y), next = corner + glm::ivec2(1, 0);
            const int own = rectangle_of(pass, corner, Draw::direction, cells * block_edge);
            numbers.insert(own);
            // The exclusive or cancels the shift of the pass.
            steps.insert(own ^ rectangle_of(pass, next, Draw::direction, cells * block_edge));
            relations.insert(own ^ rectangle_of(pass, next, Draw::direction, cells * block_edge) ^
                             rectangle_of(pass, corner, Draw::lobe, cells * block_edge) ^
                             rectangle_of(pass, next, Draw::lobe, cells * block_edge));
        }
    EXPECT_GT(numbers.size(), 142u); // of 144 blocks, with 65536 possible values
    EXPECT_GT(steps.size(), 50u);    // of 128 pairs of the net
    EXPECT_GT(relations.size(), 130u);
    for (std::size_t i = 0; i < at_x1.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            std::set<int> pairs;
            for (int y = 0; y < block_edge; ++y)
                for (int x = 0; x < block_edge; ++x)
                    pairs.insert(rectangle_of(pass, first + glm::ivec2(x, y), at_x1[i], {4, 4}) * 16 +
                                 rectangle_of(pass, first + glm::ivec2(x, y), at_x1[j], {4, 4}));
            EXPECT_GT(pairs.size(), 120u) << i << ' ' << j; // of 256; independent nets give 162
        }
}

TEST(BlockNets, BlocksUseSeveralVariants) {
    const auto scene = floor();
    constexpr glm::ivec2 large(24 * block_edge);
    const RenderSettings s = settings_of(Method::gpr);
    const Pass first(*scene, scene->camera(), large, s, LearnedReuse(large, s), 2),
        second(*scene, scene->camera(), large, s, LearnedReuse(large, s), 3); // both use the same nets
    std::set<int> of_direction, of_lobe, of_both;
    for (int y = block_edge / 2; y < large.y; y += block_edge)
        for (int x = block_edge / 2; x < large.x; x += block_edge) {
            const auto step = [&](Draw purpose) {
                return rectangle_of(first, {x, y}, purpose, {64, 64}) ^
                       rectangle_of(second, {x, y}, purpose, {64, 64});
            };
            of_direction.insert(step(Draw::direction));
            of_lobe.insert(step(Draw::lobe));
            of_both.insert(step(Draw::direction) << 12 | step(Draw::lobe));
        }
    EXPECT_GT(of_direction.size(), 10u);
    EXPECT_LE(of_direction.size(), 16u);
    EXPECT_GT(of_lobe.size(), 10u);
    EXPECT_GT(of_both.size(), 100u);
}

TEST(BlockNets, MoveTheGridOfBlocksWhenNetsBegin) {
    const auto scene = floor();
    constexpr glm::ivec2 large(3 * block_edge);
    const RenderSettings s = settings_of(Method::pt); // whose nets begin at powers of two
    std::set<std::pair<int, int>> corners;
    for (const int index : {1, 2, 4, 8, 16, 32}) {
        const glm::ivec2 corner =
            first_block(Pass(*scene, scene->camera(), large, s, LearnedReuse(large, s), index));
        corners.emplace(corner.x, corner.y);
    }
    EXPECT_GT(corners.size(), 3u);
}

/// The first digit of a choice alternates over columns. The first digit of numbers for the chosen item alternates
/// over rows.
TEST(BlockNets, ExchangeRowsAndColumnsForChoices) {
    const auto scene = floor();
    constexpr glm::ivec2 large(3 * block_edge);
    const RenderSettings s = settings_of(Method::gpr);
    const Pass pass(*scene, scene->camera(), large, s, LearnedReuse(large, s), 3);
    const glm::ivec2 corner = first_block(pass);
    for (const Draw purpose : at_x1) {
        const bool is_choice = purpose == Draw::emitter || purpose == Draw::lobe;
        const glm::ivec2 to_neighbour = is_choice ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
        for (int y = 0; y < block_edge; y += 2)
            for (int x = 0; x < block_edge; x += 2)
                EXPECT_NE(rectangle_of(pass, corner + glm::ivec2(x, y), purpose, {2, 1}),
                          rectangle_of(pass, corner + glm::ivec2(x, y) + to_neighbour, purpose, {2, 1}));
    }
}

TEST(BlockNets, NumbersAtOnePlaceOfABlockAreUniform) {
    const auto scene = floor();
    constexpr int blocks = 40;
    constexpr glm::ivec2 large(blocks * block_edge);
    const RenderSettings s = settings_of(Method::gpr);
    const Pass pass(*scene, scene->camera(), large, s, LearnedReuse(large, s), 2);
    for (const Draw purpose : at_x1) {
        std::array<int, 16> counts{};
        for (int y = 0; y < blocks; ++y)
            for (int x = 0; x < blocks; ++x)
                ++counts[static_cast<std::size_t>(
                    rectangle_of(pass, {x * block_edge + 5, y * block_edge + 9}, purpose, {4, 4}))];
        double chi2 = 0;
        for (const int count : counts)
            chi2 += std::pow(count - blocks * blocks / 16.0, 2) / (blocks * blocks / 16.0);
        EXPECT_LT(chi2, 38); // chi-square with 15 degrees of freedom: exceeded once in 1000
    }
}

} // namespace tessera::test
