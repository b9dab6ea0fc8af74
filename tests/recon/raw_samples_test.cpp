// Reconstructions that work on raw samples: they read no other images, and the unbiased ones are linear.
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <cstddef>
#include <utility>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 70, height = 50;

/// Returns samples of radiance or of a coefficient, with fireflies, half differences and features.
GradientImages raw_images(bool is_demodulated, std::uint32_t seed = 3) {
    GradientImages images = noisy_images(width, height, 1, seed);
    images.patch = 4;
    images.very_direct = random_image(width, height, seed + 50, 1, 0.1f);
    add_fireflies(images, 8);
    if (is_demodulated)
        demodulate(images);
    return images;
}

TEST(RawSamples, AreReconstructedWithoutImagesOfTheDenoiser) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : all_norms) {
            if (denoises(norm))
                continue;
            GradientImages images = raw_images(is_demodulated);
            const RgbImage picture = reconstruct(images, {norm}).image;
            images.brightest = {};
            images.halves = {};
            images.features = {};
            EXPECT_TRUE(has_same_bits(reconstruct(images, {norm}).image, picture)) << to_string(norm);
        }
}

TEST(RawSamples, OfNoneAreTheRadiancePlusDirectlyVisibleEmission) {
    for (const bool is_demodulated : {false, true}) {
        const GradientImages images = raw_images(is_demodulated);
        const Reconstruction result = reconstruct(images, {Norm::none});
        EXPECT_TRUE(has_same_bits(result.image, sum_of(images.radiance(), images.very_direct)));
        EXPECT_EQ(result.redistributed, 0);
    }
}

/// Replaces x by a x + b y.
void blend(RgbImage& x, const RgbImage& y, float a, float b) {
    for (std::size_t i = 0; i < x.size(); ++i)
        x.data()[i] = a * x.data()[i] + b * y.data()[i];
}

/// Returns images with all means equal to a x + b y. Both have the same albedo.
GradientImages blended(GradientImages x, const GradientImages& y, float a, float b) {
    blend(x.primal, y.primal, a, b);
    blend(x.dx, y.dx, a, b);
    blend(x.dy, y.dy, a, b);
    blend(x.very_direct, y.very_direct, a, b);
    blend(x.demodulation.value, y.demodulation.value, a, b);
    return x;
}

/// Returns the relative difference of f(a x + b y) and a f(x) + b f(y).
double nonlinearity(Norm norm, bool is_demodulated) {
    constexpr float a = 0.75f, b = -1.5f;
    const GradientImages x = raw_images(is_demodulated, 3), y = raw_images(is_demodulated, 4);
    RgbImage expected = reconstruct(x, {norm}).image;
    blend(expected, reconstruct(y, {norm}).image, a, b);
    return relative_difference(reconstruct(blended(x, y, a, b), {norm}).image, expected);
}

TEST(RawSamples, AreReconstructedLinearlyIfUnbiased) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : all_norms) {
            if (norm == Norm::oidn)
                continue; // needs a library that may be missing
            const bool is_unbiased = guarantee_of(norm).convergence == Convergence::unbiased;
            const double difference = nonlinearity(norm, is_demodulated);
            if (is_unbiased)
                EXPECT_LT(difference, 1e-5) << to_string(norm) << " " << is_demodulated;
            else
                EXPECT_GT(difference, 1e-3) << to_string(norm) << " " << is_demodulated;
        }
}

} // namespace

} // namespace tessera::test
