// The joint filter: it removes noise, keeps detail, and lets no light cross differences of features.
#include "recon/guided/joint_filter.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

RgbImage filtered(NoisyPicture picture, const FeatureImages& features,
                  const ParallelFor& parallel_for = serial_for) {
    return filtered_with_noise(std::move(picture), features, parallel_for).image;
}

constexpr int width = 96, height = 80;

FeatureImages even_features() {
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

RgbImage noise(std::uint32_t seed, float deviation) {
    return random_image(width, height, seed, 0, deviation);
}

/// Returns noise that is equal within each tile of 6x6 pixels.
RgbImage noise_in_tiles(std::uint32_t seed, float deviation) {
    const RgbImage values = noise(seed, deviation);
    RgbImage tiles(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            tiles(x, y) = values(x / 6, y / 6);
    return tiles;
}

TEST(JointFilter, RemovesNoise) {
    const RgbImage truth(width, height, Rgb(1));
    for (const bool tiles : {false, true}) {
        const auto make = [tiles](std::uint32_t seed) {
            return tiles ? noise_in_tiles(seed, 0.3f) : noise(seed, 0.3f);
        };
        const RgbImage picture = sum_of(truth, make(1));
        const RgbImage result = filtered({picture, make(2)}, even_features());
        EXPECT_LT(rms(result, Rgb(1)), (tiles ? 0.4 : 0.1) * rms(picture, Rgb(1))) << tiles;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean_color(result)[c], mean_color(picture)[c], 0.01) << tiles;
    }
}

/// The half differences are 0, so all detail stays.
TEST(JointFilter, KeepsAPictureWithoutNoise) {
    const RgbImage picture = random_image(width, height, 5, 1, 0.2f), none(width, height, Rgb(0));
    EXPECT_LT(relative_difference(filtered({picture, none}, even_features()), picture), 1e-5);
}

/// The picture converges as noise vanishes, also at the edge of a shadow that no feature shows.
TEST(JointFilter, IsConsistent) {
    RgbImage shadow(width, height, Rgb(1));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x)
            shadow(x, y) = Rgb(0.3f);
    double last = 1;
    for (const float deviation : {0.3f, 0.03f, 0.003f}) {
        const RgbImage picture = sum_of(shadow, noise(1, deviation));
        const RgbImage result = filtered({picture, noise(2, deviation)}, even_features());
        const double error = relative_rms_difference(result, shadow);
        EXPECT_LT(error, relative_rms_difference(picture, shadow)) << deviation;
        EXPECT_LT(error, 0.2 * last) << deviation;
        last = error;
    }
}

/// A chequered pattern that no feature shows, hardly stronger than the noise. Pairs of pixels do not separate the
/// two; means over squares of pairs, reconstruction (48), do.
TEST(JointFilter, KeepsPatternsThatNoiseHidesInPairsOfPixels) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x + y) % 2 == 0 ? 0.7f : 1.3f);
    const RgbImage picture = sum_of(truth, noise(1, 0.2f));
    const RgbImage result = filtered({picture, noise(2, 0.2f)}, even_features());
    EXPECT_LT(relative_rms_difference(result, truth), 0.65 * relative_rms_difference(picture, truth));
}

/// A few pixels have most of the noise. They differ from their neighbours, but squares around them do not.
TEST(JointFilter, RemovesNoiseWithLongTails) {
    const auto make = [](std::uint32_t seed) {
        RgbImage image = noise(seed, 0.2f);
        const RgbImage strength = noise(seed + 10, 1);
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] = Rgb((std::abs(strength.data()[i].r) > 1.5f ? 2.0f : 0.5f) * image.data()[i].r);
        return image;
    };
    const RgbImage picture = sum_of(RgbImage(width, height, Rgb(1)), make(1));
    EXPECT_LT(rms(filtered({picture, make(2)}, even_features()), Rgb(1)), 0.3 * rms(picture, Rgb(1)));
}

/// Light varies from pixel to pixel and has little noise. A few noisy pixels must not decide for their neighbours.
TEST(JointFilter, KeepsDetailBesideAFewNoisyPixels) {
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
    const RgbImage picture = sum_of(truth, noise_with_peaks(1));
    const RgbImage result = filtered({picture, noise_with_peaks(2)}, even_features());
    double squares = 0;
    int count = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (!is_noisy(x, y)) {
                squares += std::pow(static_cast<double>(result(x, y).g - truth(x, y).g), 2);
                ++count;
            }
    EXPECT_LT(std::sqrt(squares / count), 0.04);
}

/// Each feature alone keeps light out of a black half.
TEST(JointFilter, LetsNoLightCrossDifferencesOfFeatures) {
    for (const int feature : {0, 1, 2, 3}) {
        FeatureImages features = even_features();
        RgbImage picture = sum_of(RgbImage(width, height, Rgb(1)), noise(1, 0.3f)), half = noise(2, 0.3f);
        for (int y = 0; y < height; ++y)
            for (int x = width / 2; x < width; ++x) {
                picture(x, y) = half(x, y) = Rgb(0);
                if (feature == 0)
                    features.normal(x, y) = Rgb(1, 0, 0);
                else if (feature == 1)
                    features.nearness(x, y) = 0.2f;
                else if (feature == 2)
                    features.roughness(x, y) = 1;
                else
                    features.normal(x, y) = Rgb(0), features.nearness(x, y) = 0, features.albedo(x, y) = Rgb(1);
            }
        const RgbImage result = filtered({picture, half}, features);
        for (int y = 0; y < height; ++y)
            for (int x = width / 2; x < width; ++x)
                ASSERT_NEAR(result(x, y).g, 0, 3e-6) // from the ridge of the regression
                    << feature << ": " << x << " " << y;
    }
}

/// A texture under constant light.
TEST(JointFilter, FiltersLightAndKeepsTextures) {
    FeatureImages features = even_features();
    RgbImage truth(width, height), picture = noise(1, 0.2f), half = noise(2, 0.2f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            features.albedo(x, y) = (x + y) % 2 == 0 ? Rgb(0.8f, 0.2f, 0.3f) : Rgb(0.4f);
            truth(x, y) = features.albedo(x, y);
            picture(x, y) = truth(x, y) * (1.0f + picture(x, y));
            half(x, y) *= truth(x, y);
        }
    const RgbImage result = filtered({picture, half}, features);
    EXPECT_LT(relative_rms_difference(result, truth), 0.15 * relative_rms_difference(picture, truth));
}

/// Returns the image with left and right exchanged.
RgbImage mirrored(const RgbImage& image) {
    RgbImage result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            result(x, y) = image(image.width() - 1 - x, y);
    return result;
}

/// The filter has no preferred direction: it commutes with mirroring and transposition.
TEST(JointFilter, CommutesWithMirrors) {
    RgbImage picture(width, height), half(width, height);
    const RgbImage picture_noise = noise(1, 1), half_noise = noise(2, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float deviation = x < width / 2 && y < height / 3 ? 0.9f : 1e-4f;
            picture(x, y) = Rgb(1) + deviation * picture_noise(x, y);
            half(x, y) = deviation * half_noise(x, y);
        }
    using Map = std::function<RgbImage(const RgbImage&)>;
    const Map transposed = [](const RgbImage& image) {
        RgbImage result(image.height(), image.width());
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                result(y, x) = image(x, y);
        return result;
    };
    constexpr double rounding = 1e-4; // weights are bytes, and the order of sums differs
    const RgbImage result = filtered({picture, half}, {});
    for (const Map& map : {Map(mirrored), transposed})
        EXPECT_LT(relative_difference(filtered({map(picture), map(half)}, {}), map(result)), rounding);
}

/// Rows are filtered in chunks from the left. The mirrored picture has other chunks and must have the same result.
TEST(JointFilter, ShowsNoChunksOfRows) {
    constexpr int wide = 1300, high = 24;
    const RgbImage picture = random_image(wide, high, 1, 1, 0.3f), half = random_image(wide, high, 2, 0, 0.3f);
    const RgbImage result = filtered({picture, half}, {});
    EXPECT_LT(relative_difference(filtered({mirrored(picture), mirrored(half)}, {}), mirrored(result)), 1e-4);
}

/// The picture has thin black bars that no feature shows.
TEST(JointFilter, MakesNothingNegative) {
    RgbImage picture = sum_of(RgbImage(width, height, Rgb(1)), noise_in_tiles(3, 0.5f)),
             half = noise_in_tiles(4, 0.5f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            picture(x, y) = x % 16 == 5 ? Rgb(0) : glm::max(picture(x, y), Rgb(0));
            half(x, y) = x % 16 == 5 ? Rgb(0) : half(x, y);
        }
    for (Rgb c : filtered({picture, half}, even_features()))
        ASSERT_GE(std::min({c.r, c.g, c.b}), 0);
}

/// Black pictures, pictures of one pixel, denormal and huge values.
TEST(JointFilter, IsFiniteForAnyPicture) {
    const auto filter_even = [](Rgb value, int w, int h) {
        const RgbImage image(w, h, value);
        const Image<float> zero(w, h);
        return filtered({image, image}, {RgbImage(w, h, Rgb(0.5f)), RgbImage(w, h), zero, zero}, serial_for);
    };
    for (const float value : {0.0f, 3e-39f, 1e-10f, 1.0f, 1e30f, 1e38f, 3e38f})
        for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {9, 1}, {10, 10}})
            for (Rgb c : filter_even(Rgb(value), w, h))
                ASSERT_TRUE(is_finite(c)) << value << " " << w << "x" << h;
}

TEST(JointFilter, LeavesAnInfinitePictureUnchanged) {
    RgbImage picture = sum_of(RgbImage(width, height, Rgb(1)), noise(1, 0.3f));
    picture(20, 20) = Rgb(std::numeric_limits<float>::infinity());
    EXPECT_TRUE(has_same_bits(filtered({picture, noise(2, 0.3f)}, even_features()), picture));
}

/// With a fit, the filter gives the same bits for the same picture, and twice the result for twice the picture.
TEST(JointFilter, WithAFitIsHomogeneous) {
    const FeatureImages features = even_features();
    const RgbImage picture = sum_of(RgbImage(width, height, Rgb(1)), noise(1, 0.3f));
    const GuidedParameters parameters;
    const FeatureKernels kernels({width, height}, features, parameters, serial_for);
    const Image<float> local = local_brightness_of(picture, features);
    FilterFit fit;
    const auto filter_by_fit = [&](const RgbImage& image, const RgbImage& of_noise) {
        return filter({image, of_noise}, features, kernels, local, parameters, fit, serial_for).image;
    };
    const RgbImage result = filter_by_fit(picture, noise(2, 0.3f));
    ASSERT_FALSE(fit.empty());
    // The weights of the regression depend on brightness, so the filter is homogeneous only.
    EXPECT_TRUE(has_same_bits(filter_by_fit(picture, {}), result));
    RgbImage twice = picture, twice_result = result;
    for (RgbImage* image : {&twice, &twice_result})
        for (Rgb& c : *image)
            c *= 2;
    EXPECT_LT(relative_difference(filter_by_fit(twice, {}), twice_result), 1e-3);
}

} // namespace

} // namespace tessera::test
