// Light that is known to be about: to whom it is given, and that none is lost.
#include "recon/picture/light_spreader.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 40, height = 30;

/// Brighter surroundings get more of it, in proportion, at every channel alike.
TEST(SpreadLight, FollowsBrightness) {
    RgbImage picture(width, height, Rgb(1)), held(width, height, Rgb(0));
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x)
            picture(x, y) = Rgb(0.1f);
    held(19, 15) = Rgb(100, 200, 0);
    const RgbImage before = picture;
    spread_around(held, lit_surroundings(picture, anywhere(picture), {}, serial_for), picture, serial_for);
    EXPECT_NEAR(sum_of(picture), sum_of(before) + 300, 1e-2);
    const auto gain = [&](int x) { return static_cast<double>(picture(x, 15).r - before(x, 15).r); };
    EXPECT_NEAR(gain(24) / gain(15), 0.1, 0.02); // as far from both sides, beyond the blur of brightness
    EXPECT_NEAR(picture(15, 15).g - before(15, 15).g, 2 * gain(15), 1e-4);
}

/// A wall on the left and one that turns away on the right, of other albedos, the same light on both.
GuideImages two_walls() {
    GuideImages guides{RgbImage(width, height, Rgb(0.8f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                       Image<float>(width, height, 1.0f), Image<float>(width, height, 1.0f)};
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x) {
            guides.albedo(x, y) = Rgb(0.4f);
            guides.normal(x, y) = glm::vec3(1, 0, 0);
        }
    return guides;
}

/// What was found at the edge of a wall is given to all of the wall, and to nothing else.
TEST(SpreadLight, GoesToPixelsThatLookAlike) {
    const GuideImages guides = two_walls();
    RgbImage picture = guides.albedo, light(width, height, Rgb(0));
    light(19, 15) = Rgb(6, 3, 0);
    const AlikePixels alike({width, height}, guides, serial_for);
    spread_to_alike(light, picture, alike, guides, {}, serial_for);
    EXPECT_NEAR(sum_of(picture) + sum_of(light), sum_of(guides.albedo) + 9, 1e-2);
    EXPECT_LT(sum_of(light), 0.1);
    double other = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x)
            other += static_cast<double>(picture(x, y).r - guides.albedo(x, y).r);
    EXPECT_LT(other, 0.01);
    EXPECT_GT(picture(3, 5).r, 0.8f + 0.2f * 6 / 600); // far away, a fifth of an even share
    EXPECT_NEAR((picture(9, 12).r - 0.8f) / (picture(9, 12).g - 0.8f), 2, 1e-2);
    for (int y = 0; y < height; ++y)
        for (int x = 1; x < 20; ++x)
            EXPECT_GT(picture(x, y).r, picture(0, 0).r - 1e-6f) << x << ',' << y; // and none is left out
}

/// And darker ones, still alike, in proportion to their albedo.
TEST(SpreadLight, IsWhatAlbedosMakeOfIt) {
    GuideImages guides = two_walls();
    for (int y = 0; y < height; ++y)
        for (int x = y % 2; x < width; x += 2)
            guides.albedo(x, y) *= 0.8f;
    RgbImage picture = guides.albedo, light(width, height, Rgb(0));
    light(9, 12) = Rgb(9);
    spread_to_alike(light, picture, AlikePixels({width, height}, guides, serial_for), guides, {}, serial_for);
    double gains[2] = {};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 20; ++x)
            gains[(x + y) % 2] += static_cast<double>(picture(x, y).r - guides.albedo(x, y).r);
    EXPECT_NEAR(gains[0] / gains[1], 0.8, 0.08); // and a little less, being less alike to all
}

TEST(SpreadLight, HasTheSameBitsByThreads) {
    const ParallelFor in_threads = [](int count, const std::function<void(int)>& body) {
        std::vector<std::jthread> threads;
        for (int i = count - 1; i >= 0; --i)
            threads.emplace_back(body, i);
    };
    const GuideImages guides = two_walls();
    const auto spread_by = [&](const ParallelFor& parallel_for) {
        RgbImage picture = guides.albedo, light(width, height, Rgb(0));
        for (int i = 0; i < width * height; i += 7)
            light.data()[i] = Rgb(static_cast<float>(i % 31), 1, 0.3f);
        const AlikePixels alike({width, height}, guides, parallel_for);
        spread_to_alike(light, picture, alike, guides, {}, parallel_for);
        spread_around(light, lit_surroundings(picture, alike, {}, parallel_for), picture, parallel_for);
        return picture;
    };
    const RgbImage alone = spread_by(serial_for), together = spread_by(in_threads);
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), together.begin()));
}

/// A thing of one pixel has nobody to share with: what is not like it does not get it, and what would be a spike
/// again is left over.
TEST(SpreadLight, OfAPixelLikeNoOtherIsLeftOver) {
    GuideImages guides = two_walls();
    guides.nearness(9, 9) = 9;
    RgbImage picture = guides.albedo, light(width, height, Rgb(0));
    light(9, 9) = Rgb(50);
    const AlikePixels alike({width, height}, guides, serial_for);
    spread_to_alike(light, picture, alike, guides, {}, serial_for);
    EXPECT_NEAR(sum_of(picture) + sum_of(light), sum_of(guides.albedo) + 150, 1e-2);
    EXPECT_GT(light(9, 9).r, 49);
    EXPECT_LT(picture(9, 9).r, 1.0f);
}

/// Those that have no room are given nothing, and others more.
TEST(SpreadLight, IsNotGivenToPixelsWithoutRoom) {
    const GuideImages guides = two_walls();
    RgbImage picture = guides.albedo, light(width, height, Rgb(0));
    RgbImage room(width, height, Rgb(1));
    for (int x = 0; x < width; ++x)
        picture(x, 14) = room(x, 14) = Rgb(0);
    const double before = sum_of(picture);
    light(9, 13) = Rgb(5);
    spread_to_alike(light, picture, AlikePixels({width, height}, guides, serial_for), guides, room, serial_for);
    EXPECT_NEAR(sum_of(picture), before + 15, 2e-2);
    for (int x = 0; x < width; ++x)
        EXPECT_EQ(picture(x, 14), Rgb(0));
}

/// On pictures smaller than what it is spread over, and on black ones.
TEST(SpreadLight, IsKeptOnSmallAndBlackPictures) {
    for (const float brightness : {0.0f, 1e-20f, 1e20f}) {
        RgbImage picture(5, 3, Rgb(brightness)), held(5, 3, Rgb(0));
        held(1, 1) = Rgb(15);
        const double before = sum_of(picture);
        RgbImage alike = picture, left = held;
        spread_to_alike(left, alike, anywhere(picture), {}, {}, serial_for);
        EXPECT_NEAR(sum_of(alike) + sum_of(left), before + 45, 1e-4 + 1e-6 * before) << brightness;
        spread_around(held, lit_surroundings(picture, anywhere(picture), {}, serial_for), picture, serial_for);
        EXPECT_NEAR(sum_of(picture), before + 45, 1e-4 + 1e-6 * before) << brightness;
        EXPECT_TRUE(std::isfinite(picture(4, 2).g));
    }
}

/// However dark the picture is, and however bright what is spread.
TEST(SpreadLight, IsAFiniteNumber) {
    for (const float brightness : {0.0f, 1e-38f, 1e-30f, 1e30f})
        for (const float light : {1e-30f, 1.0f, 1e12f, 1e30f}) {
            RgbImage picture(width, height, Rgb(brightness)), held(width, height, Rgb(0));
            picture(5, 5) = Rgb(2 * brightness);
            held(20, 15) = Rgb(light, 0, -light);
            spread_to_alike(held, picture, anywhere(picture), {}, {}, serial_for);
            spread_around(held, lit_surroundings(picture, anywhere(picture), {}, serial_for), picture, serial_for);
            EXPECT_TRUE(std::all_of(picture.begin(), picture.end(), is_finite)) << brightness << ' ' << light;
        }
}

} // namespace

} // namespace tessera::test
