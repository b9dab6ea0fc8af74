// First-order regression on features, reconstruction (53) to (55): its definition, and the noise that it removes
// at edges.
#include "recon/guided/feature_regression.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Plane random_plane(int width, int height, std::uint32_t seed, float mean, float deviation) {
    const RgbImage image = random_image(width, height, seed, mean, deviation);
    Plane plane(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        plane.data()[i] = image.data()[i].g;
    return plane;
}

constexpr float ridge = 1e-5f;

struct Case {
    FeaturePlanes features;
    std::array<Plane, 6> values;
    Plane weights;

    Case(int width, int height) {
        std::uint32_t seed = 0;
        for (Plane& feature : features)
            feature = random_plane(width, height, ++seed, 1, 1);
        std::fill(features[3].begin(), features[3].end(), 0.7f); // one feature is constant
        for (Plane& value : values)
            value = random_plane(width, height, ++seed, 1, 1);
        weights = random_plane(width, height, ++seed, 0, 2);
        for (float& w : weights)
            w = std::exp(w);
    }

    std::array<Plane, 6> fitted(const ParallelFor& parallel_for = serial_for) const {
        std::array<Plane, 6> fitted;
        make_planes(fitted, weights.width(), weights.height());
        write_regressions(values, features, weights, ridge, parallel_for, fitted);
        return fitted;
    }
};

using Equations = std::array<std::array<double, feature_count + 2>, feature_count + 1>;

/// Returns the last unknown, by Gaussian elimination with pivots.
double last_unknown(Equations e) {
    constexpr std::size_t n = feature_count + 1;
    for (std::size_t j = 0; j < n; ++j) {
        std::size_t pivot = j;
        for (std::size_t i = j; i < n; ++i)
            if (std::abs(e[i][j]) > std::abs(e[pivot][j]))
                pivot = i;
        std::swap(e[j], e[pivot]);
        for (std::size_t i = j + 1; i < n; ++i)
            for (std::size_t k = n + 1; k-- > j;)
                e[i][k] -= e[i][j] / e[j][j] * e[j][k];
    }
    return e[n - 1][n] / e[n - 1][n - 1];
}

/// Returns the regression of one pixel and channel in double precision, by its definition.
double naive(const Case& c, std::size_t channel, int x, int y) {
    Equations e{};
    double all = 0;
    const auto add = [&](int qx, int qy, double w) {
        double terms[feature_count + 2];
        for (std::size_t k = 0; k < feature_count; ++k)
            terms[k] = static_cast<double>(c.features[k](qx, qy) - c.features[k](x, y));
        terms[feature_count] = 1;
        terms[feature_count + 1] = static_cast<double>(c.values[channel](qx, qy));
        for (std::size_t i = 0; i <= feature_count; ++i)
            for (std::size_t j = 0; j < feature_count + 2; ++j)
                e[i][j] += w * terms[i] * terms[j];
    };
    for (int qy = std::max(0, y - 2); qy <= std::min(c.weights.height() - 1, y + 2); ++qy)
        for (int qx = std::max(0, x - 2); qx <= std::min(c.weights.width() - 1, x + 2); ++qx) {
            add(qx, qy, static_cast<double>(c.weights(qx, qy)));
            all += static_cast<double>(c.weights(qx, qy));
        }
    for (std::size_t k = 0; k < feature_count; ++k)
        e[k][k] += static_cast<double>(ridge) * all + 1e-5 * e[k][k]; // the second term prevents rounding errors
    return last_unknown(e);
}

TEST(FeatureRegression, SolvesTheLeastSquaresOfEachSquare) {
    for (const auto& [width, height] : {std::pair(37, 9), std::pair(16, 5), std::pair(3, 2), std::pair(1, 1)}) {
        const Case c(width, height);
        const std::array<Plane, 6> fitted = c.fitted();
        for (std::size_t channel = 0; channel < 6; ++channel)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    ASSERT_NEAR(fitted[channel](x, y), naive(c, channel, x, y), 1e-3)
                        << width << 'x' << height << ": " << x << ',' << y;
    }
}

/// Features are constant in some squares, and vary in others of the same row.
TEST(FeatureRegression, LeavesOutConstantFeatures) {
    Case c(61, 9);
    for (std::size_t k = 0; k < feature_count; ++k)
        for (int y = 0; y < 9; ++y)
            std::fill_n(c.features[k].row(y), 7 * k, static_cast<float>(k));
    const std::array<Plane, 6> fitted = c.fitted();
    for (std::size_t channel = 0; channel < 6; ++channel)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 61; ++x)
                ASSERT_NEAR(fitted[channel](x, y), naive(c, channel, x, y), 1e-3) << x << ',' << y;
}

/// A constant feature with one NaN.
TEST(FeatureRegression, LeavesPixelsBesideANaNUnchanged) {
    Case c(61, 9);
    const std::array<Plane, 6> before = c.fitted();
    c.features[3](20, 4) = std::numeric_limits<float>::quiet_NaN();
    const std::array<Plane, 6> after = c.fitted();
    for (std::size_t channel = 0; channel < 6; ++channel)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 61; ++x) {
                const bool is_beside = std::max(std::abs(x - 20), std::abs(y - 4)) <= 2;
                ASSERT_NEAR(after[channel](x, y), (is_beside ? c.values : before)[channel](x, y), 1e-5)
                    << x << ',' << y;
            }
}

/// For any features and weights, also those of a pixel that is 10^7 times as bright as its neighbours.
TEST(FeatureRegression, KeepsAConstantPicture) {
    Case c(35, 12);
    for (Plane& value : c.values)
        std::fill(value.begin(), value.end(), 2.0f);
    c.weights(7, 5) = 1e-14f;
    for (const Plane& plane : c.fitted())
        for (float a : plane)
            ASSERT_NEAR(a, 2, 1e-5);
}

TEST(FeatureRegression, KeepsAFirstOrderFunctionOfFeatures) {
    Case c(40, 20);
    for (std::size_t i = 0; i < c.weights.size(); ++i)
        c.values[0].data()[i] = 3 + 2 * c.features[1].data()[i] - c.features[6].data()[i];
    const std::array<Plane, 6> fitted = c.fitted();
    for (std::size_t i = 0; i < c.weights.size(); ++i)
        EXPECT_NEAR(fitted[0].data()[i], c.values[0].data()[i], 0.1);
}

TEST(FeatureRegression, HasTheSameBitsInAnyOrder) {
    const Case c(50, 30);
    const std::array<Plane, 6> forward = c.fitted(), backward = c.fitted(backwards_for);
    for (std::size_t channel = 0; channel < 6; ++channel)
        EXPECT_TRUE(std::equal(forward[channel].begin(), forward[channel].end(), backward[channel].begin()));
}

/// Pixels that see different fractions of two surfaces, so that no two pixels have similar features.
struct Edges {
    static constexpr int width = 64, height = 64;
    FeatureImages features{RgbImage(width, height), RgbImage(width, height, Rgb(0, 0, 1)),
                           Image<float>(width, height, 1), Image<float>(width, height, 0.1f)};
    RgbImage truth{width, height};

    Edges() {
        const Plane fractions = random_plane(width, height, 77, 0, 1);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const float fraction = 1 / (1 + std::exp(-3 * fractions.data()[i]));
            features.albedo.data()[i] = Rgb(0.1f + 0.8f * fraction);
            features.normal.data()[i] = (1 - fraction) * Rgb(0, 0, 1) + fraction * Rgb(1, 0, 0);
            truth.data()[i] = Rgb(0.2f + 2 * fraction, 0.5f, 1.5f - fraction);
        }
    }

    /// Errors of the filtered picture and of its filtered noise, both relative to the error of the noisy picture.
    struct Errors {
        double picture, noise;
    };
    Errors errors(float deviation) const {
        RgbImage picture = truth;
        const RgbImage noise = random_image(width, height, 1, 0, deviation);
        for (std::size_t i = 0; i < picture.size(); ++i)
            picture.data()[i] += noise.data()[i];
        const double before = relative_rms_difference(picture, truth);
        const NoisyPicture smooth =
            filtered_with_noise({std::move(picture), random_image(width, height, 2, 0, deviation)}, features);
        RgbImage with_noise = truth;
        for (std::size_t i = 0; i < with_noise.size(); ++i)
            with_noise.data()[i] += smooth.noise.data()[i];
        return {relative_rms_difference(smooth.image, truth) / before,
                relative_rms_difference(with_noise, truth) / before};
    }
};

TEST(FeatureRegression, RemovesTheNoiseOfEdges) {
    const Edges::Errors errors = Edges().errors(0.1f);
    EXPECT_LT(errors.picture, 0.6);
    EXPECT_NEAR(errors.noise, errors.picture, 0.3 * errors.picture);
}

/// Detail that no feature shows stays as noise vanishes.
TEST(FeatureRegression, IsConsistent) {
    Edges edges;
    const RgbImage other = random_image(Edges::width, Edges::height, 5, 0, 0.2f);
    for (std::size_t i = 0; i < other.size(); ++i)
        edges.truth.data()[i] += glm::abs(other.data()[i]);
    EXPECT_LT(edges.errors(1e-3f).picture, 1.05);
    EXPECT_LT(edges.errors(1e-4f).picture, 1.001);
}

/// Few samples find light. The many black pixels must not darken their neighbours.
TEST(FeatureRegression, KeepsTheBrightnessOfNoisyPixels) {
    const Edges edges;
    const auto random_hits = [](std::uint32_t seed, float sign) {
        std::mt19937 engine(seed);
        RgbImage factors(Edges::width, Edges::height);
        for (Rgb& factor : factors) {
            int hits = 0;
            for (int sample = 0; sample < 8; ++sample)
                hits += engine() % 32 == 0 ? (sample % 2 ? static_cast<int>(sign) : 1) : 0;
            factor = Rgb(static_cast<float>(4 * hits));
        }
        return factors;
    };
    RgbImage picture = random_hits(1, 1), noise = random_hits(2, -1);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        picture.data()[i] *= edges.truth.data()[i];
        noise.data()[i] *= edges.truth.data()[i];
    }
    const double before = mean_color(picture).r;
    const NoisyPicture smooth = filtered_with_noise({std::move(picture), std::move(noise)}, edges.features);
    EXPECT_NEAR(mean_color(smooth.image).r, before, 0.02 * before);
}

/// Features from a file may be NaN, or overflow when they are squared.
TEST(FeatureRegression, OfOneInvalidPixelLeavesOthersUnchanged) {
    for (const float invalid : {2e19f, std::numeric_limits<float>::quiet_NaN()}) {
        Edges edges;
        const RgbImage noise = random_image(Edges::width, Edges::height, 2, 0, 0.1f);
        const RgbImage before = filtered_with_noise({edges.truth, noise}, edges.features).image;
        edges.features.normal(20, 20).z = invalid;
        const RgbImage after = filtered_with_noise({edges.truth, noise}, edges.features).image;
        for (int y = 0; y < Edges::height; ++y)
            for (int x = 0; x < Edges::width; ++x) {
                ASSERT_TRUE(std::isfinite(after(x, y).g)) << x << ',' << y;
                if (std::max(std::abs(x - 20), std::abs(y - 20)) > 2) {
                    ASSERT_NEAR(after(x, y).g, before(x, y).g, 0.1) << x << ',' << y;
                }
            }
    }
}

} // namespace

} // namespace tessera::test
