// Bounds of a picture by what each pixel's own samples say.
#include "recon/picture/bounds.h"
#include "recon/picture/demodulation.h"
#include "recon/picture/reconstruct.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 30, height = 20;

/// Pixels of value 1 and variance 3 x 0.01, in tiles, that all look alike.
GradientImages even_images() {
    GradientImages images;
    images.primal = RgbImage(width, height, Rgb(1));
    images.dx = images.dy = images.very_direct = RgbImage(width, height, Rgb(0));
    images.primal_variance = Image<float>(width, height, 0.01f);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.01f);
    images.patch = 6;
    images.guides = {RgbImage(width, height, Rgb(0.5f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                     Image<float>(width, height, 1.0f), Image<float>(width, height, 1.0f)};
    return images;
}

RgbImage bounded(const GradientImages& images, float value, const ParallelFor& parallel_for = serial_for) {
    RgbImage image(width, height, Rgb(value));
    const AlikePixels alike({width, height}, images.guides, parallel_for);
    take_excess(upper_bounds(images, images, alike, parallel_for), 2, image, parallel_for);
    return image;
}

/// The sky behind a window whose bar is dark and sure of it: its pixels are held to that, the sky keeps its
/// freedom.
TEST(Bounds, DarkAmongDarkStaysDark) {
    GradientImages images = even_images();
    for (int y = 0; y < height; ++y)
        for (int x = 10; x < 13; ++x) {
            images.primal(x, y) = Rgb(0.001f);
            images.primal_variance(x, y) = 1e-10f;
            images.guides.nearness(x, y) = 2;
        }
    const RgbImage high = bounded(images, 1.15f);
    EXPECT_LT(high(11, 9).r, 0.01f);
    EXPECT_FLOAT_EQ(high(25, 9).r, 1.15f);
    EXPECT_NEAR(bounded(images, 9)(25, 9).r, 1.2f, 1e-5f);
    EXPECT_EQ(bounded(images, 0.2f)(25, 9).r, 0.2f);
}

/// A pixel whose samples all happened to be black, among others that are not.
TEST(Bounds, DarkByChanceIsNoKnowledge) {
    GradientImages images = even_images();
    images.primal(15, 10) = Rgb(0);
    images.primal_variance(15, 10) = 0;
    for (float& v : images.primal_variance)
        v *= 25;
    EXPECT_GT(bounded(images, 0.7f)(15, 10).r, 0.69f);
}

/// A tile whose paths all happened to find nothing, on a wall where others found light.
TEST(Bounds, ATileThatIsDarkByChanceIsNoKnowledge) {
    GradientImages images = even_images();
    for (float& v : images.primal_variance)
        v *= 100;
    for (int y = 6; y < 12; ++y)
        for (int x = 12; x < 18; ++x) {
            images.primal(x, y) = Rgb(0);
            images.primal_variance(x, y) = 0;
        }
    EXPECT_GT(bounded(images, 0.7f)(15, 9).r, 0.69f);
    for (int y = 6; y < 12; ++y)
        for (int x = 12; x < 18; ++x)
            images.guides.albedo(x, y) = Rgb(0, 0.5f, 2); // a thing of its own
    EXPECT_LT(bounded(images, 0.7f)(15, 9).r, 0.01f);
}

/// Light is so rare that most tiles have found none: what the solver brings there is all that is known.
TEST(Bounds, AreNoneWhereMostHaveFoundNothing) {
    GradientImages images = even_images();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (x / 6 % 3 != 0) {
                images.primal(x, y) = Rgb(0);
                images.primal_variance(x, y) = 0;
            }
    EXPECT_EQ(bounded(images, 0.4f)(9, 9).r, 0.4f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (x / 6 % 3 == 2)
                images.primal(x, y) = Rgb(1);
    EXPECT_LT(bounded(images, 0.4f)(9, 9).r, 0.2f);
}

/// Pixels that have paths of their own alone are dark by chance as a rule, and what has no variance has no error.
TEST(Bounds, AreThoseOfPixelsThatShare) {
    GradientImages images = even_images();
    EXPECT_TRUE(can_bound(images));
    images.patch = 1;
    EXPECT_FALSE(can_bound(images));
    images = even_images();
    images.primal_variance = {};
    EXPECT_FALSE(can_bound(images));
}

/// Of light over albedo the bound is about the picture that the primal makes: what samples happened to see of a
/// texture says nothing against what is known of it.
TEST(Bounds, AreAboutThePictureOfThePrimal) {
    GradientImages images = even_images();
    Demodulation& d = images.demodulation;
    d.value = RgbImage(width, height, Rgb(0.2f));
    d.albedo = RgbImage(width, height, Rgb(0.5f));
    d.sampled_albedo = RgbImage(width, height, Rgb(0.2f)); // all samples fell on dark texels
    d.sampled_variance = d.value_covariance = RgbImage(width, height, Rgb(0));
    d.albedo_variance = Image<float>(width, height, 0.2f);
    d.sampled_share = d.unexplained_variance = Image<float>(width, height, 0.0f);
    RgbImage picture = images.primal;
    remodulate(images, false, picture, serial_for);
    EXPECT_NEAR(picture(5, 5).r, 0.5f, 1e-3f);
    EXPECT_NEAR(bounded(images, 2)(5, 5).r, picture(5, 5).r + 2 * 0.2f * 0.1f, 1e-5f);
}

TEST(Bounds, ArePlainNumbersWhateverTheVariances) {
    GradientImages images = even_images();
    images.primal_variance(3, 3) = 3e38f;
    images.primal_variance(20, 3) = std::numeric_limits<float>::infinity();
    for (int x = 0; x < width; ++x)
        images.primal_variance(x, 15) = 0;
    for (const Rgb& c : bounded(images, 5))
        EXPECT_TRUE(is_finite(c));
    GradientImages black = even_images();
    black.primal = RgbImage(width, height, Rgb(0));
    black.primal_variance = Image<float>(width, height, 0.0f);
    EXPECT_EQ(bounded(black, 5)(7, 7).r, 5); // nobody has found anything
}

TEST(Bounds, HaveTheSameBitsWithThreads) {
    GradientImages images = even_images();
    for (int i = 0; i < width * height; ++i)
        images.primal_variance.data()[i] *= static_cast<float>(1 + i % 17);
    const ParallelFor in_threads = [](int count, const std::function<void(int)>& body) {
        std::vector<std::jthread> threads;
        for (int i = count - 1; i >= 0; --i)
            threads.emplace_back(body, i);
    };
    const RgbImage image = bounded(images, 1.7f, in_threads), alone = bounded(images, 1.7f);
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), image.begin()));
}

/// The light that a spike's tile holds back is spread: over the floor, but not over a dark bar in front of it.
/// None of it is lost.
TEST(Bounds, SpreadLightKeepsOffWhatLooksOtherwise) {
    GradientImages images = even_images();
    BrightestSamples& b = images.brightest;
    b.samples = 8;
    b.primal = RgbImage(width, height, Rgb(1.5f));
    b.dx = b.dy = RgbImage(width, height, Rgb(0));
    for (int y = 8; y < 12; ++y)
        for (int x = 14; x < 18; ++x) {
            b.primal(x, y) = Rgb(33);
            images.primal(x, y) = Rgb(5);
            images.primal_variance(x, y) = 48;
        }
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < 25; ++x) {
            images.primal(x, y) = b.primal(x, y) = Rgb(0.001f);
            images.primal_variance(x, y) = 1e-12f;
            images.guides.nearness(x, y) = 2;
        }
    const RgbImage picture = reconstruct(images, {.norm = Norm::none}).image;
    EXPECT_LT(picture(20, 10).r, 0.008f);
    EXPECT_GT(picture(19, 10).r, 1.05f);
    EXPECT_GT(picture(28, 10).r, 1.05f); // and the floor beyond it gets as much
    double sum = 0, sum_found = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        sum += static_cast<double>(picture.data()[i].r);
        sum_found += static_cast<double>(images.primal.data()[i].r);
    }
    EXPECT_NEAR(sum, sum_found, 1e-4 * sum_found);
}

/// Spikes at the edge of things that stand before nothing: no glow around them, and no light lost.
TEST(Bounds, WhatSeesNothingIsBlack) {
    GradientImages images = even_images();
    images.patch = 1;
    BrightestSamples& b = images.brightest;
    b.samples = 8;
    b.primal = RgbImage(width, height, Rgb(1.5f));
    b.dx = b.dy = RgbImage(width, height, Rgb(0));
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x) {
            images.primal(x, y) = b.primal(x, y) = Rgb(0);
            images.guides.nearness(x, y) = 0;
        }
    images.primal(18, 10) = Rgb(5);
    b.primal(18, 10) = Rgb(33);
    images.primal(24, 5) = b.primal(24, 5) = Rgb(0.5f); // no look has led there, but a sample has
    double sum = 0, sum_found = 0;
    for (const Norm norm : {Norm::none, Norm::weighted}) {
        const RgbImage picture = reconstruct(images, {.norm = norm}).image;
        for (int y = 0; y < height; ++y)
            for (int x = 20; x < width; ++x)
                EXPECT_EQ(is_black(picture(x, y)), x != 24 || y != 5) << x << ',' << y;
        for (std::size_t i = 0; i < picture.size(); ++i) {
            sum += static_cast<double>(picture.data()[i].r);
            sum_found += static_cast<double>(images.primal.data()[i].r);
        }
    }
    EXPECT_NEAR(sum, sum_found, 1e-3 * sum_found);
}

} // namespace

} // namespace tessera::test
