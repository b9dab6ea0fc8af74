// Radiance from a reconstructed coefficient: recombine(), theory (29), is unbiased; remodulate(), reconstruction
// (45), has less noise.
#include "recon/guided/demodulation.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 21, height = 17;

RgbImage random_image(unsigned seed, float low, float high) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(low, high);
    RgbImage image(width, height);
    for (Rgb& c : image)
        c = {uniform(engine), uniform(engine), uniform(engine)};
    return image;
}

/// Returns noisy primal and gradients, with variances.
GradientImages random_gradients() {
    GradientImages images{random_image(1, 0, 2), random_image(2, -1, 1), random_image(3, -1, 1),
                          random_image(4, 0, 1)};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(width, height, 0.1f);
    return images;
}

Demodulation demodulation_by(const RgbImage& primal, const RgbImage& albedo) {
    const RgbImage black(width, height);
    const Image<float> none(width, height);
    Demodulation d{black, albedo, albedo, none, none, black, black, none};
    for (std::size_t i = 0; i < d.value.size(); ++i)
        d.value.data()[i] = albedo.data()[i] * primal.data()[i];
    return d;
}

TEST(Remodulation, ByAnAlbedoOfOneChangesNothing) {
    const GradientImages plain = random_gradients();
    GradientImages demodulated = plain;
    demodulated.demodulation = demodulation_by(plain.primal, RgbImage(width, height, Rgb(1)));
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // needs a library that may be missing
        const RgbImage a = reconstruct(plain, {norm}).image, b = reconstruct(demodulated, {norm}).image;
        if (norm == Norm::guided || norm == Norm::smoothed)
            EXPECT_TRUE(has_same_bits(a, b)) << to_string(norm);
        else
            // recombine() rounds value - primal + image.
            EXPECT_LT(relative_difference(b, a), 1e-6) << to_string(norm);
    }
}

TEST(Remodulation, OfThePrimalIsTheMeanRadiance) {
    GradientImages images = random_gradients();
    images.demodulation = demodulation_by(images.primal, random_image(5, 0.1f, 1));
    images.demodulation.value = random_image(6, 0, 1); // any covariance of albedo and coefficient
    images.demodulation.albedo = random_image(7, 0.1f, 1);
    const RgbImage image = reconstruct(images, {Norm::none}).image;
    for (std::size_t i = 0; i < image.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.data()[i][c],
                        images.demodulation.value.data()[i][c] + images.very_direct.data()[i][c], 1e-6f);
}

TEST(Remodulation, OfAConstantCoefficientIsItsProductWithTheAlbedo) {
    GradientImages images;
    images.primal = RgbImage(width, height, Rgb(3, 2, 1));
    images.dx = images.dy = RgbImage(width, height, Rgb(0));
    const RgbImage albedo = random_image(8, 0.1f, 1);
    images.demodulation = demodulation_by(images.primal, albedo);
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // needs a library that may be missing
        const RgbImage image = reconstruct(images, {norm}).image;
        for (std::size_t i = 0; i < image.size(); ++i)
            EXPECT_LT(glm::distance(image.data()[i], albedo.data()[i] * Rgb(3, 2, 1)), 1e-4f) << to_string(norm);
    }
}

/// Returns images of n samples of albedo and coefficient at every pixel, with this correlation between the two.
GradientImages sampled(int n, float correlation, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<float> normal;
    GradientImages images;
    images.primal = RgbImage(width, height);
    images.primal_variance = Image<float>(width, height, 3 * 0.04f / static_cast<float>(n));
    const RgbImage black(width, height);
    const Image<float> none(width, height);
    Demodulation d{black, RgbImage(width, height, Rgb(0.5f)),
                   black, Image<float>(width, height, 3 * 0.01f),
                   none,  black,
                   black, none};
    const float unexplained = 3 * 0.04f * (1 - correlation * correlation) / static_cast<float>(n);
    d.unexplained_variance = Image<float>(width, height, unexplained);
    for (std::size_t i = 0; i < images.primal.size(); ++i)
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < n; ++k) {
                const float x = normal(engine), y = normal(engine);
                const float a = 0.5f + 0.1f * x;
                const float e = 1 + 0.2f * (correlation * x + std::sqrt(1 - correlation * correlation) * y);
                images.primal.data()[i][c] += e / static_cast<float>(n);
                d.sampled_albedo.data()[i][c] += a / static_cast<float>(n);
                d.value.data()[i][c] += a * e / static_cast<float>(n);
                d.sampled_variance.data()[i][c] += a * a / static_cast<float>(n);
                d.value_covariance.data()[i][c] += a * a * e / static_cast<float>(n);
            }
    for (std::size_t i = 0; i < images.primal.size(); ++i) {
        const Rgb a = d.sampled_albedo.data()[i];
        d.sampled_variance.data()[i] -= a * a;
        d.value_covariance.data()[i] -= a * d.value.data()[i];
    }
    images.demodulation = d;
    return images;
}

double mean_of(const RgbImage& image) {
    double sum = 0;
    for (const Rgb& c : image)
        sum += static_cast<double>(c.r + c.g + c.b);
    return sum / (3 * static_cast<double>(image.size()));
}

/// If albedo and coefficient are independent, rho of reconstruction (45) is noise, and at most a tenth of it
/// stays. If they are correlated, the covariance is added at many samples.
TEST(Remodulation, AddsACovarianceThatStandsOutFromNoise) {
    RgbImage independent(width, height, Rgb(1)), many = independent;
    remodulate(sampled(16, 0, 1), GuidedParameters(), independent, serial_for);
    double squares = 0;
    for (const Rgb& c : independent)
        squares += static_cast<double>(glm::dot(c - Rgb(0.5f), c - Rgb(0.5f))) / 3;
    EXPECT_LT(squares / static_cast<double>(independent.size()), 0.1 * 0.01 * 0.04 / 16); // a tenth of rho's noise
    remodulate(sampled(400, 0.9f, 3), GuidedParameters(), many, serial_for);
    EXPECT_NEAR(mean_of(many), 0.5 + 0.9 * 0.02, 0.0005); // E[a e]
}

/// If all samples of a pixel hit the same one of its two surfaces, the slope comes from the neighbours, and not
/// from rounding errors.
TEST(Remodulation, TakesTheSlopeOfTwoSurfacesFromThePixelsAround) {
    const float a[] = {0.8f, 0.1f}, e[] = {0.25f, 2}; // equal radiance; the product of means is 2.5 times as large
    for (const float rounding : {0.0f, 1e-12f}) {
        GradientImages images;
        images.primal = RgbImage(3, 1);
        images.primal_variance = Image<float>(3, 1);
        const RgbImage black(3, 1), value(3, 1, Rgb(0.2f));
        const Image<float> none(3, 1), spread(3, 1, 3 * 0.1225f);
        Demodulation d{value, RgbImage(3, 1, Rgb(0.45f)), black, spread, none, black, black, none};
        for (int x = 0; x < 3; ++x) { // pixels 0 and 2 see the first surface, pixel 1 both
            const float fraction = x == 1 ? 0.5f : 1;
            d.sampled_albedo(x, 0) = Rgb(fraction * a[0] + (1 - fraction) * a[1]);
            images.primal(x, 0) = Rgb(fraction * e[0] + (1 - fraction) * e[1]);
            d.sampled_variance(x, 0) = Rgb(x == 1 ? 0.1225f : rounding);
            d.value_covariance(x, 0) = Rgb(x == 1 ? 0 : rounding * 1e6f);
        }
        images.demodulation = d;
        RgbImage image = images.primal;
        remodulate(images, GuidedParameters(), image, serial_for);
        for (int x = 0; x < 3; ++x)
            EXPECT_NEAR(image(x, 0).r, 0.2f, 0.02f) << x << ", " << rounding;
    }
}

/// The samples of the middle pixel missed its surface with the larger albedo. Its neighbour has a slope of 100
/// from an albedo that hardly varies, which the middle pixel must not use. Huge variances give finite pictures.
TEST(Remodulation, TakesNoSlopeFromPixelsWhoseAlbedoHardlyVaries) {
    GradientImages images;
    images.primal = RgbImage(3, 1, Rgb(1.3f));
    images.primal_variance = Image<float>(3, 1);
    const RgbImage black(3, 1), albedo(3, 1, Rgb(0.01f));
    const Image<float> none(3, 1);
    Demodulation d{black, albedo, albedo, none, none, black, black, none};
    for (int x = 0; x < 3; ++x)
        d.value(x, 0) = albedo(x, 0) * images.primal(x, 0);
    d.albedo(1, 0) = Rgb(0.014f);
    d.sampled_variance(0, 0) = Rgb(1e-4f);
    d.value_covariance(0, 0) = Rgb(1e-2f);
    for (const float variance : {3 * 0.0033f, 1e20f, std::numeric_limits<float>::max()}) {
        d.albedo_variance(1, 0) = variance;
        images.demodulation = d;
        RgbImage image = images.primal;
        remodulate(images, GuidedParameters(), image, serial_for);
        EXPECT_NEAR(image(1, 0).r, 0.014f * 1.3f, 0.006f) << variance;
    }
}

/// reconstruction (47) takes means of roots, so that one noisy pixel does not remove the covariance of its
/// neighbours.
TEST(Remodulation, KeepsTheCovarianceBesideANoisyPixel) {
    RgbImage image(width, height, Rgb(1)), with_noise = image;
    GradientImages images = sampled(400, 0.9f, 5);
    remodulate(images, GuidedParameters(), image, serial_for);
    images.demodulation.unexplained_variance(10, 8) *= 3000;
    remodulate(images, GuidedParameters(), with_noise, serial_for);
    for (int y = 7; y <= 9; ++y)
        for (int x = 9; x <= 11; ++x)
            EXPECT_NEAR(with_noise(x, y).r, image(x, y).r, 0.001f) << x << ", " << y;
}

/// Also at two samples a pixel, and for a wrong albedo.
TEST(Recombination, IsUnbiasedForAnyAlbedo) {
    double sum = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        GradientImages images = sampled(2, 0.9f, seed);
        images.demodulation.albedo = RgbImage(width, height, Rgb(0.7f));
        RgbImage image(width, height, Rgb(1)); // the coefficient without noise
        recombine(images, image, serial_for);
        sum += mean_of(image) / 200;
    }
    EXPECT_NEAR(sum, 0.5 + 0.9 * 0.02, 0.0006);
}

} // namespace

} // namespace tessera::test
