// Error metrics, and measures against two noisy references.
#include "recon/metrics/metrics.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

TEST(Metrics, AgreeWithKnownValues) {
    const RgbImage reference(4, 3, Rgb(2)), image(4, 3, Rgb(3));
    const ErrorMetrics m = measure_error(image, reference);
    EXPECT_NEAR(m.relative_mse, 1 / 4.001, 1e-12);
    EXPECT_NEAR(m.relative_mse_trimmed, 1 / 4.001, 1e-12);
    EXPECT_NEAR(m.mse, 1, 1e-12);
    EXPECT_NEAR(m.mape, 1 / 2.01, 1e-12);
    EXPECT_NEAR(m.mean_ratio, 1.5, 1e-12);
    EXPECT_EQ(m.bad_pixels, 0u);
}

TEST(Metrics, AreMeansOverChannels) {
    const RgbImage reference(2, 1, Rgb(0));
    RgbImage image(reference);
    image(1, 0) = Rgb(0, 0, 3);
    const ErrorMetrics m = measure_error(image, reference);
    EXPECT_NEAR(m.mse, 9.0 / 6, 1e-12);
    EXPECT_NEAR(m.relative_mse, 9.0 / 6 / 0.001, 1e-8);
}

TEST(Metrics, OfEqualImagesAreZero) {
    const RgbImage image = random_image(13, 7, 2, 5);
    const ErrorMetrics m = measure_error(image, image);
    EXPECT_EQ(m.relative_mse, 0);
    EXPECT_EQ(m.mape, 0);
    EXPECT_EQ(m.mean_ratio, 1);
}

TEST(Metrics, TrimmedLeavesOutTheWorstPixels) {
    const RgbImage reference(200, 100, Rgb(1)); // 0.01 % are 2 pixels
    RgbImage image(200, 100, Rgb(1.1f));
    image(3, 4) = Rgb(1e6f);
    image(50, 60) = Rgb(1e5f);
    const ErrorMetrics m = measure_error(image, reference);
    EXPECT_GT(m.relative_mse, 1e6);
    EXPECT_NEAR(m.relative_mse_trimmed, 0.01 / 1.001, 1e-6);
}

TEST(Metrics, CountInvalidPixels) {
    const RgbImage reference(200, 100, Rgb(1));
    RgbImage image(reference);
    image(3, 4).g = NAN;
    image(5, 6).r = INFINITY;
    const ErrorMetrics m = measure_error(image, reference);
    EXPECT_EQ(m.bad_pixels, 2u);
    EXPECT_FALSE(std::isfinite(m.relative_mse));
    EXPECT_EQ(m.relative_mse_trimmed, 0);
}

TEST(Metrics, RejectDifferentSizes) {
    EXPECT_THROW(measure_error(RgbImage(2, 3), RgbImage(3, 2)), std::invalid_argument);
    EXPECT_THROW(measure_error(RgbImage(), RgbImage()), std::invalid_argument);
    EXPECT_THROW(measure_floor_free_error(RgbImage(2, 3), RgbImage(2, 3), RgbImage(3, 3)), std::invalid_argument);
}

RgbImage plus(RgbImage image, const RgbImage& noise) {
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] += noise.data()[i];
    return image;
}

TEST(FloorFreeError, IsUnbiased) {
    const int width = 160, height = 120;
    const RgbImage truth(width, height, Rgb(1));
    const auto noisy = [&](std::uint32_t seed, float deviation) {
        return plus(truth, random_image(width, height, seed, 0, deviation));
    };
    double sum = 0, variance = 0;
    constexpr int rounds = 20;
    for (std::uint32_t i = 0; i < rounds; ++i) {
        const RgbImage image = noisy(3 * i, 0.1f), r1 = noisy(3 * i + 1, 0.05f), r2 = noisy(3 * i + 2, 0.05f);
        const FloorFreeError error = measure_floor_free_error(image, r1, r2);
        // Against one noisy reference, the error includes the noise of the reference.
        EXPECT_NEAR(measure_error(image, r1).relative_mse, 0.0125, 0.0005);
        sum += error.relative_mse;
        variance += error.standard_error * error.standard_error;
    }
    // The mean of (I - t)^2 is 0.01. To first order, the mean of 1 / (r^2 + epsilon) is 1 + 3 var(r) - epsilon,
    // with var(r) = 0.00125.
    const double expected = 0.01 * (1 + 3 * 0.00125 - 0.001);
    EXPECT_NEAR(sum / rounds, expected, 4 * std::sqrt(variance) / rounds);
    EXPECT_LT(std::sqrt(variance) / rounds, 1e-4 * 0.5);
}

TEST(FloorFreeError, OfTheTruthIsZeroWithinItsStandardError) {
    const RgbImage truth(160, 120, Rgb(1));
    double squares = 0;
    constexpr int rounds = 30;
    for (std::uint32_t i = 0; i < rounds; ++i) {
        const RgbImage r1 = plus(truth, random_image(160, 120, 2 * i + 100, 0, 0.02f));
        const RgbImage r2 = plus(truth, random_image(160, 120, 2 * i + 101, 0, 0.02f));
        const FloorFreeError error = measure_floor_free_error(truth, r1, r2);
        squares += std::pow(error.relative_mse / error.standard_error, 2);
    }
    // Sum of 30 squares of nearly standard normal numbers.
    EXPECT_GT(squares, 10);
    EXPECT_LT(squares, 65);
}

/// The noise of the references is as large as the dark quarter is bright. If one reference both sorted the pixels
/// and measured their change, dark pixels would appear too bright.
TEST(EnergyChange, IsMeasuredByQuarters) {
    constexpr int width = 128, height = 128;
    RgbImage truth(width, height), image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int quarter = 4 * x / width;
            truth(x, y) = Rgb(1 + 10.0f * static_cast<float>(quarter));
            image(x, y) = truth(x, y) * (1 + 0.1f * static_cast<float>(quarter));
        }
    RgbImage r1 = truth, r2 = truth;
    const RgbImage noise1 = test::random_image(width, height, 1), noise2 = test::random_image(width, height, 2);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        r1.data()[i] += noise1.data()[i];
        r2.data()[i] += noise2.data()[i];
    }
    const std::array<double, 4> change = measure_energy_change(image, r1, r2);
    for (int quarter = 0; quarter < 4; ++quarter)
        EXPECT_NEAR(change[quarter], 0.1 * quarter, 0.02) << quarter;
    const std::array<double, 4> none = measure_energy_change(
        RgbImage(width, height, Rgb(5)), RgbImage(width, height, Rgb(5)), RgbImage(width, height, Rgb(5)));
    for (const double c : none)
        EXPECT_NEAR(c, 0, 1e-9);
}

/// The truth is constant: noise of the references must not make any quarter appear too bright or too dark.
TEST(EnergyChange, IgnoresTheNoiseOfTheReferences) {
    const RgbImage image(160, 160, Rgb(1));
    RgbImage r1 = test::random_image(160, 160, 3, 1, 0.5f), r2 = test::random_image(160, 160, 4, 1, 0.5f);
    for (const double c : measure_energy_change(image, r1, r2))
        EXPECT_NEAR(c, 0, 0.03);
    EXPECT_GT(measure_energy_change(image, r1, r1)[0], 0.3);
}

TEST(ReferenceError, IsTheErrorOfTheMeanOfTwo) {
    const RgbImage truth(160, 120, Rgb(1));
    const RgbImage r1 = plus(truth, random_image(160, 120, 1, 0, 0.1f));
    const RgbImage r2 = plus(truth, random_image(160, 120, 2, 0, 0.1f));
    RgbImage mean(160, 120);
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean.data()[i] = 0.5f * (r1.data()[i] + r2.data()[i]);
    const FloorFreeError known = measure_reference_error(r1, r2);
    EXPECT_NEAR(known.relative_mse, measure_error(mean, truth).relative_mse, 5 * known.standard_error);
    EXPECT_NEAR(known.relative_mse, 0.005, 0.0003);
    // Against its own halves, the mean has minus this error.
    EXPECT_NEAR(known.relative_mse, -measure_floor_free_error(mean, r1, r2).relative_mse, 1e-7);
}

} // namespace
} // namespace tessera
