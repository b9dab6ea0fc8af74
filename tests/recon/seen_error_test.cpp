// PSNR and FLIP, errors of pictures as a screen shows them.
#include "recon/metrics/seen_error.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 64, height = 48;

enum class Change { none, tint, dots, shift };

/// Returns waves and squares in linear radiance, with one kind of change.
RgbImage picture(Change change) {
    RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double source_x = change == Change::shift ? (x + width - 2) % width : x;
            glm::dvec3 c(0.5 + 0.4 * std::sin(0.3 * source_x), 0.4 + 0.3 * std::cos(0.2 * y + 0.1 * source_x),
                         (static_cast<int>(source_x) / 8 + y / 8) % 2 * 0.7 + 0.1);
            if (change == Change::tint)
                c *= glm::dvec3(1.1, 0.95, 1);
            if (change == Change::dots && (x * 7 + y * 13) % 17 == 0)
                c += 0.4;
            for (int i = 0; i < 3; ++i)
                image(x, y)[i] = static_cast<float>(std::clamp(c[i], 0.0, 1.0));
        }
    return image;
}

/// The expected values come from the program of the authors [Andersson 2020], version 1.7.
TEST(Flip, AgreesWithItsAuthorsProgram) {
    struct Known {
        Change change;
        double mean;
        float inside, corner;
    };
    for (const Known& known : {Known{Change::tint, 0.16983463, 0.18939729f, 0.20800868f},
                               Known{Change::dots, 0.10896316, 0.10214482f, 0.60371280f},
                               Known{Change::shift, 0.40041888, 0.37432066f, 0.87160710f}}) {
        const RgbImage changed = picture(known.change), reference = picture(Change::none);
        EXPECT_NEAR(mean_flip(changed, reference), known.mean, 2e-4);
        const Image<float> map = flip(changed, reference);
        EXPECT_NEAR(map(30, 20), known.inside, 5e-4f);
        EXPECT_NEAR(map(0, 0), known.corner, 5e-4f);
    }
}

TEST(Flip, OfEqualPicturesIsZeroAndOfBlackAndWhiteOne) {
    EXPECT_EQ(mean_flip(picture(Change::none), picture(Change::none)), 0);
    EXPECT_NEAR(mean_flip(RgbImage(9, 7, Rgb(1)), RgbImage(9, 7, Rgb(0))), 1, 0.05);
    // Values above 1 count as white.
    EXPECT_EQ(mean_flip(RgbImage(9, 7, Rgb(1)), RgbImage(9, 7, Rgb(30))), 0);
}

TEST(Flip, HasTheSameBitsWithThreads) {
    const RgbImage a = picture(Change::tint), b = picture(Change::none);
    const Image<float> one = flip(a, b), other = flip(a, b, backwards_for);
    EXPECT_TRUE(std::equal(one.begin(), one.end(), other.begin()));
}

TEST(Psnr, IsThatOfSrgbValues) {
    // The sRGB values of 0.5 and 0.4 are 0.7354 and 0.6652.
    const RgbImage a(4, 4, Rgb(0.5f)), b(4, 4, Rgb(0.4f));
    EXPECT_NEAR(psnr(a, b, b), -20 * std::log10(0.735357 - 0.665185), 1e-3);
    EXPECT_EQ(psnr(a, a, a), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(psnr(RgbImage(4, 4, Rgb(0.45f)), a, b)))
        << "the product of the differences is negative";
}

/// With two references their noise cancels, and PSNR shows the noise of the picture only.
TEST(Psnr, ExcludesTheNoiseOfReferences) {
    const int edge = 300;
    const auto noisy = [&](std::uint32_t seed, float deviation) {
        return random_image(edge, edge, seed, 0.5f, deviation);
    };
    const RgbImage truth(edge, edge, Rgb(0.5f)), image = noisy(1, 0.01f);
    const double expected = psnr(image, truth, truth);
    EXPECT_NEAR(psnr(image, noisy(2, 0.03f), noisy(3, 0.03f)), expected, 0.4);
    EXPECT_LT(psnr(image, noisy(2, 0.03f), noisy(2, 0.03f)), expected - 5);
}

TEST(Psnr, RejectsDifferentSizes) {
    EXPECT_THROW(psnr(RgbImage(2, 2), RgbImage(2, 3), RgbImage(2, 2)), std::invalid_argument);
    EXPECT_THROW(flip(RgbImage(2, 2), RgbImage(3, 2)), std::invalid_argument);
    EXPECT_THROW(flip(RgbImage(), RgbImage()), std::invalid_argument);
}

} // namespace
} // namespace tessera::test
