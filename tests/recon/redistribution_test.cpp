// Redistribution of clamped energy, reconstruction (59) and (60): which pixels get it, and that its sum stays.
#include "recon/guided/redistribution.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 40, height = 30;

/// Returns the picture with the energy redistributed over it.
RgbImage redistributed(const RgbImage& energy, RgbImage picture, const FeatureImages& features,
                       const GuidedParameters& parameters = {}, const ParallelFor& parallel_for = serial_for) {
    const FeatureKernels kernels({picture.width(), picture.height()}, features, parameters, parallel_for);
    const Image<float> local = local_brightness_of(picture, features, parameters, parallel_for);
    redistribute(energy, kernels, features, local, parameters, parallel_for, picture);
    return picture;
}

/// Returns parameters with which pixels may get any energy from pixels with similar features.
GuidedParameters without_limit() {
    GuidedParameters parameters;
    parameters.largest_addition = 1e6f;
    return parameters;
}

/// Returns parameters with which all energy goes to the pixels around, whatever their features.
GuidedParameters around_only() {
    GuidedParameters parameters;
    parameters.largest_addition = 0;
    return parameters;
}

/// Returns the features of two walls, left and right, with different normals and albedos.
FeatureImages two_walls() {
    FeatureImages features{RgbImage(width, height, Rgb(0.8f)), Image<glm::vec3>(width, height, glm::vec3(0, 0, 1)),
                           Image<float>(width, height, 1.0f), Image<float>(width, height, 1.0f)};
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x) {
            features.albedo(x, y) = Rgb(0.4f);
            features.normal(x, y) = glm::vec3(1, 0, 0);
        }
    return features;
}

TEST(Redistribution, FollowsBrightnessAround) {
    RgbImage picture(width, height, Rgb(1)), energy(width, height, Rgb(0));
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x)
            picture(x, y) = Rgb(0.1f);
    energy(19, 15) = Rgb(100, 200, 0);
    const RgbImage result = redistributed(energy, picture, {}, around_only());
    EXPECT_NEAR(sum_of(result), sum_of(picture) + 300, 1e-2);
    const auto gain = [&](int x) { return static_cast<double>(result(x, 15).r - picture(x, 15).r); };
    EXPECT_LT(gain(26), 0.5 * gain(13));
    EXPECT_NEAR(result(15, 15).g - picture(15, 15).g, 2 * gain(15), 1e-3);
}

TEST(Redistribution, GoesToPixelsWithSimilarFeatures) {
    const FeatureImages features = two_walls();
    RgbImage energy(width, height, Rgb(0));
    energy(19, 15) = Rgb(6, 3, 0);
    const RgbImage result = redistributed(energy, features.albedo, features);
    EXPECT_NEAR(sum_of(result), sum_of(features.albedo) + 9, 1e-2);
    double other = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 20; x < width; ++x)
            other += static_cast<double>(result(x, y).r - features.albedo(x, y).r);
    EXPECT_LT(other, 0.1);
    EXPECT_GT(result(3, 5).r, 0.8f + 0.2f * 6 / 600); // far away: at least a fifth of the mean gain
    EXPECT_NEAR((result(9, 12).r - 0.8f) / (result(9, 12).g - 0.8f), 2, 2e-2);
    const auto gain_around = [&](int x, int y) { // kernels skip single pixels
        float gain = 0;
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i)
                gain += result(x + i, y + j).r - features.albedo(x + i, y + j).r;
        return gain;
    };
    for (int y = 6; y < 25; ++y)
        for (int x = 8; x < 18; ++x)
            EXPECT_GT(gain_around(x, y), 0) << x << ',' << y;
}

TEST(Redistribution, IsProportionalToAlbedo) {
    FeatureImages features = two_walls();
    for (int y = 0; y < height; ++y)
        for (int x = y % 2; x < width; x += 2)
            features.albedo(x, y) *= 0.8f;
    RgbImage energy(width, height, Rgb(0));
    energy(9, 12) = Rgb(9);
    const RgbImage result = redistributed(energy, features.albedo, features, without_limit());
    double gains[2] = {};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 20; ++x)
            gains[(x + y) % 2] += static_cast<double>(result(x, y).r - features.albedo(x, y).r);
    EXPECT_NEAR(gains[0] / gains[1], 0.8, 0.08);
}

/// No pixel has features like an object of one pixel. Its energy goes to the pixels around.
TEST(Redistribution, OfAPixelWithUniqueFeaturesGoesAround) {
    FeatureImages features = two_walls();
    features.nearness(9, 9) = 9;
    RgbImage energy(width, height, Rgb(0));
    energy(9, 9) = Rgb(50);
    const RgbImage result = redistributed(energy, features.albedo, features);
    EXPECT_NEAR(sum_of(result), sum_of(features.albedo) + 150, 1e-2);
    EXPECT_LT(result(9, 9).r, 3);
    EXPECT_GT(result(8, 9).r, 0.85f);
}

/// One pixel in 250 has all energy of a uniformly lit picture.
TEST(Redistribution, OfRareLightMakesNoNewFireflies) {
    std::mt19937 random(7);
    RgbImage energy(width, height), picture(width, height);
    for (std::size_t i = 0; i < energy.size(); ++i)
        if (random() % 250 == 0) {
            energy.data()[i] = Rgb(249);
            picture.data()[i] = Rgb(1);
        }
    const RgbImage result = redistributed(energy, picture, {}), even(width, height, Rgb(1));
    EXPECT_LT(relative_rms_difference(result, even), 0.2 * relative_rms_difference(sum_of(picture, energy), even));
    EXPECT_NEAR(sum_of(result), sum_of(picture) + sum_of(energy), 1e-4 * sum_of(energy));
}

TEST(Redistribution, HasTheSameBitsWithThreads) {
    const FeatureImages features = two_walls();
    RgbImage energy(width, height, Rgb(0));
    for (int i = 0; i < width * height; i += 7)
        energy.data()[i] = Rgb(static_cast<float>(i % 31), 1, 0.3f);
    const RgbImage alone = redistributed(energy, features.albedo, features),
                   together = redistributed(energy, features.albedo, features, {}, threads_for);
    EXPECT_TRUE(has_same_bits(alone, together));
}

TEST(Redistribution, OfNoEnergyChangesNothing) {
    const FeatureImages features = two_walls();
    EXPECT_TRUE(has_same_bits(redistributed(RgbImage(width, height), features.albedo, features), features.albedo));
}

/// Pictures smaller than the kernels, and black ones.
TEST(Redistribution, KeepsTheSumOnSmallAndBlackPictures) {
    for (const float brightness : {0.0f, 1e-20f, 1e20f}) {
        const RgbImage picture(5, 3, Rgb(brightness));
        RgbImage energy(5, 3, Rgb(0));
        energy(1, 1) = Rgb(15);
        const double before = sum_of(picture);
        for (const GuidedParameters& parameters : {GuidedParameters(), around_only(), without_limit()}) {
            const RgbImage result = redistributed(energy, picture, {}, parameters);
            EXPECT_NEAR(sum_of(result), before + 45, 1e-4 + 1e-6 * before) << brightness;
            EXPECT_TRUE(std::isfinite(result(4, 2).g));
        }
    }
}

TEST(Redistribution, IsFiniteForAnyBrightness) {
    for (const float brightness : {0.0f, 1e-38f, 1e-30f, 1e30f})
        for (const float radiance : {1e-30f, 1.0f, 1e12f, 1e30f}) {
            RgbImage picture(width, height, Rgb(brightness)), energy(width, height, Rgb(0));
            picture(5, 5) = Rgb(2 * brightness);
            energy(20, 15) = Rgb(radiance, 0, -radiance);
            const RgbImage result = redistributed(energy, picture, {});
            EXPECT_TRUE(std::all_of(result.begin(), result.end(), is_finite)) << brightness << ' ' << radiance;
        }
}

} // namespace

} // namespace tessera::test
