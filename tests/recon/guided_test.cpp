// Smoothing by guides: what is noise goes, what is not stays, and nothing crosses what looks different.
#include "recon/picture/guided.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

RgbImage smoothed(NoisyPicture picture, const GuideImages& guides, const ParallelFor& parallel_for = serial_for) {
    return smoothed_with_noise(std::move(picture), guides, parallel_for).image;
}

constexpr int width = 96, height = 80;

GuideImages even_guides() {
    return {RgbImage(width, height, Rgb(0.5f)), RgbImage(width, height, Rgb(0, 0, 1)),
            Image<float>(width, height, 1), Image<float>(width, height, 0.1f)};
}

double rms(const RgbImage& image, Rgb truth, int margin = 0) {
    double sum = 0, count = 0;
    for (int y = margin; y < image.height() - margin; ++y)
        for (int x = margin; x < image.width() - margin; ++x, ++count) {
            const glm::dvec3 d(image(x, y) - truth);
            sum += glm::dot(d, d);
        }
    return std::sqrt(sum / count);
}

RgbImage plus(const RgbImage& a, const RgbImage& b) {
    RgbImage sum = a;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum.data()[i] += b.data()[i];
    return sum;
}

RgbImage noise(std::uint32_t seed, float deviation) {
    return random_image(width, height, seed, 0, deviation);
}

/// The same noise in squares of 6x6 pixels, as tiles have it.
RgbImage noise_in_tiles(std::uint32_t seed, float deviation) {
    const RgbImage values = noise(seed, deviation);
    RgbImage tiles(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            tiles(x, y) = values(x / 6, y / 6);
    return tiles;
}

TEST(Guided, NoiseGoes) {
    const RgbImage truth(width, height, Rgb(1));
    for (const bool tiles : {false, true}) {
        const auto make = [tiles](std::uint32_t seed) {
            return tiles ? noise_in_tiles(seed, 0.3f) : noise(seed, 0.3f);
        };
        const RgbImage picture = plus(truth, make(1));
        const RgbImage smooth = smoothed({picture, make(2)}, even_guides());
        EXPECT_LT(rms(smooth, Rgb(1)), (tiles ? 0.4 : 0.1) * rms(picture, Rgb(1))) << tiles;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean_color(smooth)[c], mean_color(picture)[c], 0.01) << tiles;
    }
}

/// What both halves agree on is no noise, whatever guides say: a picture without any is kept.
TEST(Guided, WithoutNoiseNothingChanges) {
    const RgbImage picture = random_image(width, height, 5, 1, 0.2f), none(width, height, Rgb(0));
    EXPECT_LT(relative_difference(smoothed({picture, none}, even_guides()), picture), 1e-5);
}

/// As samples grow, the picture goes to that of the solver: a hundredth of the noise leaves the edge of a shadow
/// that no guide shows.
TEST(Guided, IsConsistent) {
    RgbImage shadow(width, height, Rgb(1));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x)
            shadow(x, y) = Rgb(0.3f);
    double last = 1;
    for (const float deviation : {0.3f, 0.03f, 0.003f}) {
        const RgbImage picture = plus(shadow, noise(1, deviation));
        const RgbImage smooth = smoothed({picture, noise(2, deviation)}, even_guides());
        const double error = relative_rms_difference(smooth, shadow);
        EXPECT_LT(error, relative_rms_difference(picture, shadow)) << deviation;
        EXPECT_LT(error, 0.2 * last) << deviation;
        last = error;
    }
}

/// A chequered light that no guide shows, in noise as strong: two pixels hardly tell it from that, but squares do.
/// (0.57 of the error is left, 0.82 by pairs alone. Of squares of two pixels, 0.85 is: RESULTS.md, "Fewer,
/// straighter kernels".)
TEST(Guided, PatternsAreKeptThatPairsOfPixelsCannotTell) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x + y) % 2 == 0 ? 0.7f : 1.3f);
    const RgbImage picture = plus(truth, noise(1, 0.2f));
    const RgbImage smooth = smoothed({picture, noise(2, 0.2f)}, even_guides());
    EXPECT_LT(relative_rms_difference(smooth, truth), 0.65 * relative_rms_difference(picture, truth));
}

/// Noise of which a few pixels have much and most have little: these few look unlike all around, but the squares
/// around them do not. (0.33 of it by pairs alone.)
TEST(Guided, NoiseWithLongTailsGoes) {
    const auto make = [](std::uint32_t seed) {
        RgbImage image = noise(seed, 0.2f);
        const RgbImage strength = noise(seed + 10, 1);
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] = Rgb((std::abs(strength.data()[i].r) > 1.5f ? 2.0f : 0.5f) * image.data()[i].r);
        return image;
    };
    const RgbImage picture = plus(RgbImage(width, height, Rgb(1)), make(1));
    EXPECT_LT(rms(smoothed({picture, make(2)}, even_guides()), Rgb(1)), 0.3 * rms(picture, Rgb(1)));
}

/// Light that changes from pixel to pixel where little noise is, and here and there a pixel of much: it does not
/// decide on the others around.
TEST(Guided, AFewNoisyPixelsLeaveTheOthersAlone) {
    const auto is_noisy = [](int x, int y) { return (5 * x + 7 * y) % 53 == 0; };
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb(1 + 0.5f * std::cos(static_cast<float>(x)));
    const auto noise_with_peaks = [&](std::uint32_t seed) {
        RgbImage image = noise(seed, 0.03f);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image(x, y) *= is_noisy(x, y) ? 50.0f : 1.0f;
        return image;
    };
    const RgbImage picture = plus(truth, noise_with_peaks(1));
    const RgbImage smooth = smoothed({picture, noise_with_peaks(2)}, even_guides());
    double squares = 0;
    int count = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (!is_noisy(x, y)) {
                squares += std::pow(static_cast<double>(smooth(x, y).g - truth(x, y).g), 2);
                ++count;
            }
    EXPECT_LT(std::sqrt(squares / count), 0.04);
}

/// Light does not cross to what looks different: nor does it get into the black.
TEST(Guided, GuidesHoldLight) {
    for (const int guide : {0, 1, 2, 3}) {
        GuideImages guides = even_guides();
        RgbImage picture = plus(RgbImage(width, height, Rgb(1)), noise(1, 0.3f)), half = noise(2, 0.3f);
        for (int y = 0; y < height; ++y)
            for (int x = width / 2; x < width; ++x) {
                picture(x, y) = half(x, y) = Rgb(0);
                if (guide == 0)
                    guides.normal(x, y) = Rgb(1, 0, 0);
                else if (guide == 1)
                    guides.nearness(x, y) = 0.2f;
                else if (guide == 2)
                    guides.roughness(x, y) = 1;
                else
                    guides.normal(x, y) = Rgb(0), guides.nearness(x, y) = 0, guides.albedo(x, y) = Rgb(1);
            }
        const RgbImage smooth = smoothed({picture, half}, guides);
        for (int y = 0; y < height; ++y)
            for (int x = width / 2; x < width; ++x)
                ASSERT_NEAR(smooth(x, y).g, 0, 3e-6) << guide << ": " << x << " " << y; // a regression's ridge
    }
}

/// A texture under even light stays one.
TEST(Guided, LightIsSmoothedTexturesAreNot) {
    GuideImages guides = even_guides();
    RgbImage truth(width, height), picture = noise(1, 0.2f), half = noise(2, 0.2f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            guides.albedo(x, y) = (x + y) % 2 == 0 ? Rgb(0.8f, 0.2f, 0.3f) : Rgb(0.4f);
            truth(x, y) = guides.albedo(x, y);
            picture(x, y) = truth(x, y) * (1.0f + picture(x, y));
            half(x, y) *= truth(x, y);
        }
    const RgbImage smooth = smoothed({picture, half}, guides);
    EXPECT_LT(relative_rms_difference(smooth, truth), 0.15 * relative_rms_difference(picture, truth));
}

TEST(Guided, SameBitsForAnyThreadsAndAnyUnitOfLight) {
    const GradientImages images = noisy_images(64, 48);
    const auto picture = [&](float scale, const ParallelFor& parallel_for) {
        const GradientImages scaled = noisy_images(64, 48, scale);
        return reconstruct(scaled, {Norm::guided}, parallel_for).image;
    };
    const RgbImage one = picture(1, serial_for), other = picture(1, backwards_for),
                   large = picture(1024, serial_for);
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(one.data()[i], other.data()[i]);
        ASSERT_NEAR(large.data()[i].g, 1024 * one.data()[i].g, 0.01f * 1024);
    }
}

/// Of methods with gradients as of those without.
TEST(Guided, IsNearerToTheTruth) {
    GradientImages images = noisy_images(64, 48), truth = images;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            truth.primal(x, y) =
                Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
    for (const bool gradients : {true, false}) {
        if (!gradients)
            images.dx = images.dy = images.halves.dx = images.halves.dy = {};
        const double before = relative_rms_difference(reconstruct(images, {Norm::weighted}).image, truth.primal);
        const Norm norm = gradients ? Norm::guided : Norm::smoothed;
        const double after = relative_rms_difference(reconstruct(images, {norm}).image, truth.primal);
        EXPECT_LT(after, (gradients ? 0.9 : 0.5) * before);
    }
}

/// Left and right exchanged.
RgbImage mirrored(const RgbImage& image) {
    RgbImage result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            result(x, y) = image(image.width() - 1 - x, y);
    return result;
}

/// What lies to the right of much noise is smoothed, and kept, as what lies to the left, above or below.
TEST(Guided, MirrorsAreAlike) {
    RgbImage picture(width, height), half(width, height);
    const RgbImage one = noise(1, 1), other = noise(2, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float deviation = x < width / 2 && y < height / 3 ? 0.9f : 1e-4f;
            picture(x, y) = Rgb(1) + deviation * one(x, y);
            half(x, y) = deviation * other(x, y);
        }
    using Map = std::function<RgbImage(const RgbImage&)>;
    const Map transposed = [](const RgbImage& image) {
        RgbImage result(image.height(), image.width());
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                result(y, x) = image(x, y);
        return result;
    };
    constexpr double rounding = 1e-4; // some weights are a byte more or less, as sums go the other way round
    const RgbImage smooth = smoothed({picture, half}, {});
    for (const Map& map : {Map(mirrored), transposed})
        EXPECT_LT(relative_difference(smoothed({map(picture), map(half)}, {}), map(smooth)), rounding);
}

/// Rows are worked on a part at a time, from the left: where parts end does not show.
TEST(Guided, WidePicturesAreAsNarrowOnes) {
    constexpr int wide = 1300, high = 24;
    const RgbImage picture = random_image(wide, high, 1, 1, 0.3f), half = random_image(wide, high, 2, 0, 0.3f);
    const RgbImage smooth = smoothed({picture, half}, {});
    EXPECT_LT(relative_difference(smoothed({mirrored(picture), mirrored(half)}, {}), mirrored(smooth)), 1e-4);
}

/// Thin black bars that no guide shows: nothing comes out below black.
TEST(Guided, NothingIsBelowBlack) {
    RgbImage picture = plus(RgbImage(width, height, Rgb(1)), noise_in_tiles(3, 0.5f)),
             half = noise_in_tiles(4, 0.5f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            picture(x, y) = x % 16 == 5 ? Rgb(0) : glm::max(picture(x, y), Rgb(0));
            half(x, y) = x % 16 == 5 ? Rgb(0) : half(x, y);
        }
    for (Rgb c : smoothed({picture, half}, even_guides()))
        ASSERT_GE(std::min({c.r, c.g, c.b}), 0);
}

/// A bar that is dark, and whose samples know it, before a bright sky of much noise: no guide shows it, and it
/// stays.
TEST(Guided, WhatIsSurelyDarkStaysDark) {
    GradientImages images;
    images.primal = plus(RgbImage(width, height, Rgb(1)), noise_in_tiles(3, 0.3f));
    images.halves.primal = noise_in_tiles(4, 0.3f);
    images.primal_variance = Image<float>(width, height, 3 * 0.09f);
    images.guides = even_guides();
    images.patch = 6;
    for (int y = 0; y < height; ++y)
        for (int x = 46; x < 49; ++x) {
            images.primal(x, y) = Rgb(0.01f);
            images.halves.primal(x, y) = Rgb(1e-4f);
            images.primal_variance(x, y) = 3e-8f;
        }
    const RgbImage picture = reconstruct(images, {Norm::smoothed}).image;
    for (int y = 0; y < height; ++y)
        ASSERT_LT(picture(47, y).g, 0.02f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_color(picture)[c], mean_color(images.primal)[c], 0.01);
}

/// Of black, of one pixel, and of numbers that are hardly any more.
TEST(Guided, TakesAnyPicture) {
    const auto smooth = [](Rgb value, int w, int h) {
        const RgbImage image(w, h, value);
        const Image<float> zero(w, h);
        return smoothed({image, image}, {RgbImage(w, h, Rgb(0.5f)), RgbImage(w, h), zero, zero}, serial_for);
    };
    for (const float value : {0.0f, 3e-39f, 1e-10f, 1.0f, 1e30f, 1e38f, 3e38f})
        for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {9, 1}, {10, 10}})
            for (Rgb c : smooth(Rgb(value), w, h))
                ASSERT_TRUE(is_finite(c)) << value << " " << w << "x" << h;
}

/// One sample has no halves, and files may have no guides: then there is nothing to smooth by.
TEST(Guided, WithoutHalvesOrGuidesIsWeighted) {
    for (const bool halves : {false, true}) {
        GradientImages images = noisy_images(40, 30);
        if (halves)
            images.halves = {};
        else
            images.guides = {};
        const RgbImage guided = reconstruct(images, {Norm::guided}).image;
        EXPECT_EQ(relative_difference(guided, reconstruct(images, {Norm::weighted}).image), 0);
    }
}

} // namespace
} // namespace tessera::test
