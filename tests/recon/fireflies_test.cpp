// Fireflies: which samples are clamped, reconstruction (56) to (58), what that changes, and that no energy is
// lost.
#include "recon/guided/fireflies.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 40, height = 30;
const GuidedParameters parameters;

/// The factor by which a sample of n may exceed the mean of the others.
double factor_of(int n) {
    return static_cast<double>(
        std::max(parameters.firefly_factor, parameters.firefly_fraction * static_cast<float>(n)));
}

ClampedSamples clamped(const GradientImages& images, const ParallelFor& parallel_for = serial_for) {
    return clamp_fireflies(images, parameters, parallel_for);
}

/// Samples of every pixel, and the means and brightest samples that a film makes of them.
struct Samples {
    explicit Samples(int n) : passes(static_cast<std::size_t>(n), RgbImage(width, height, Rgb(1))) {}

    GradientImages images() const {
        const double n = static_cast<double>(passes.size());
        GradientImages result;
        BrightestSamples& b = result.brightest;
        for (RgbImage* image : {&result.primal, &result.dx, &result.dy, &b.primal, &b.dx, &b.dy})
            *image = RgbImage(width, height, Rgb(0));
        for (Image<float>* image : {&result.primal_variance, &result.dx_variance, &result.dy_variance})
            *image = Image<float>(width, height);
        b.samples = static_cast<int>(passes.size());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                double sum = 0, squares = 0;
                Rgb sum_x(0), sum_y(0);
                float brightest = 0;
                for (const RgbImage& s : passes) {
                    const Rgb here = s(x, y), dx = x + 1 < width ? s(x + 1, y) - here : Rgb(0),
                              dy = y + 1 < height ? s(x, y + 1) - here : Rgb(0);
                    sum += static_cast<double>(here.r);
                    squares += 3 * static_cast<double>(here.r * here.r);
                    sum_x += dx;
                    sum_y += dy;
                    if (const float size = std::max({here.r, std::abs(dx.r), std::abs(dy.r)}); size > brightest) {
                        brightest = size;
                        b.primal(x, y) = here;
                        b.dx(x, y) = dx;
                        b.dy(x, y) = dy;
                    }
                }
                result.primal(x, y) = Rgb(static_cast<float>(sum / n));
                result.dx(x, y) = sum_x / static_cast<float>(n);
                result.dy(x, y) = sum_y / static_cast<float>(n);
                result.primal_variance(x, y) = static_cast<float>((squares - 3 * sum * sum / n) / (n * (n - 1)));
            }
        return result;
    }

    std::vector<RgbImage> passes;
};

bool is_in_tile(int x, int y) {
    return x >= 12 && x < 18 && y >= 10 && y < 16;
}

/// Returns 16 samples of 1, except for one sample of a tile of 6x6 pixels, which is 1000.
Samples with_firefly_tile() {
    Samples samples(16);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (is_in_tile(x, y))
                samples.passes[5](x, y) = Rgb(1000);
    return samples;
}

TEST(Fireflies, AreClampedToAFractionOfTheOtherSamples) {
    const ClampedSamples result = clamped(with_firefly_tile().images());
    const double limit = factor_of(16);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_lit = is_in_tile(x, y);
            EXPECT_NEAR(result.images.primal(x, y).r, is_lit ? (15 + limit) / 16 : 1, 1e-3) << x << ' ' << y;
            EXPECT_NEAR(result.clamped(x, y).g, is_lit ? (1000 - limit) / 16 : 0, 1e-3) << x << ' ' << y;
        }
}

/// Inside the tile, both pixels of a gradient have the firefly; at its border, only one has it.
TEST(Fireflies, AreClampedInGradientsAsInThePrimal) {
    constexpr double tolerance = 1.01 / 16; // the ordinary radiance of the sample is scaled down, too
    const GradientImages images = clamped(with_firefly_tile().images()).images;
    for (int y = 0; y + 1 < height; ++y)
        for (int x = 0; x + 1 < width; ++x) {
            EXPECT_NEAR(images.dx(x, y).r, images.primal(x + 1, y).r - images.primal(x, y).r, tolerance);
            EXPECT_NEAR(images.dy(x, y).r, images.primal(x, y + 1).r - images.primal(x, y).r, tolerance);
        }
}

/// The solver needs the variances of the raw samples, so that it does not trust such a pixel.
TEST(Fireflies, LeaveVariancesUnchanged) {
    const GradientImages images = with_firefly_tile().images();
    const ClampedSamples result = clamped(images);
    EXPECT_EQ(result.images.primal_variance(15, 13), images.primal_variance(15, 13));
    EXPECT_GT(result.images.primal_variance(15, 13), 1000);
}

/// Remodulation needs the variance of the clamped samples: here 15 samples of 1 and one of the limit.
TEST(Fireflies, ReduceTheUnexplainedVarianceToThatOfClampedSamples) {
    GradientImages images = with_firefly_tile().images();
    const RgbImage black(width, height), white(width, height, Rgb(1));
    const Image<float> none(width, height);
    images.demodulation = {images.primal, white, white, none, none, black, black, images.primal_variance};
    images.brightest.albedo = white;
    const GradientImages result = clamped(images).images;
    const double limit = factor_of(16), mean = (15 + limit) / 16,
                 squares = 15 * (1 - mean) * (1 - mean) + (limit - mean) * (limit - mean);
    EXPECT_NEAR(result.demodulation.unexplained_variance(15, 13), 3 * squares / (16 * 15), 1e-3);
    EXPECT_EQ(result.demodulation.unexplained_variance(3, 3), images.primal_variance(3, 3));
}

/// With demodulation, the clamped radiance is the albedo of the sample times its clamped coefficient,
/// reconstruction (58).
TEST(Fireflies, AreClampedInRadianceWithDemodulation) {
    GradientImages images = with_firefly_tile().images();
    demodulate(images);
    const ClampedSamples result = clamped(images);
    EXPECT_NEAR(sum_of(result.images.radiance()) + sum_of(result.clamped), sum_of(images.radiance()),
                1e-5 * sum_of(images.radiance()));
    const Rgb lost = (images.primal(15, 13) - result.images.primal(15, 13)) * images.brightest.albedo(15, 13);
    EXPECT_NEAR(result.clamped(15, 13).g, lost.g, 1e-3 * static_cast<double>(lost.g));
}

/// Half differences lose the clamped part of the sample with the sign of its half.
TEST(Fireflies, AreClampedInHalfDifferences) {
    GradientImages images = with_firefly_tile().images();
    images.brightest.half = Image<float>(width, height, -1);
    images.halves = {RgbImage(width, height), RgbImage(width, height), RgbImage(width, height)};
    const ClampedSamples result = clamped(images);
    EXPECT_NEAR(result.images.halves.primal(15, 13).r, result.clamped(15, 13).r, 1e-3);
    EXPECT_EQ(result.images.halves.primal(3, 3).r, 0);
}

TEST(Fireflies, KeepTheSumOfClampedAndRemainingRadiance) {
    const GradientImages images = with_firefly_tile().images();
    const ClampedSamples result = clamped(images);
    EXPECT_NEAR(sum_of(result.images.primal) + sum_of(result.clamped), sum_of(images.primal),
                1e-5 * sum_of(images.primal));
    EXPECT_GT(sum_of(result.clamped), 0.5 * sum_of(images.primal));
}

/// All samples of a bright pixel have the same value.
TEST(Fireflies, AreNotThePixelsThatAreBrightInEverySample) {
    for (const int n : {2, 3, 4, 5, 6, 7, 16}) {
        Samples samples(n);
        for (RgbImage& sample : samples.passes)
            sample(9, 9) = Rgb(300);
        const ClampedSamples result = clamped(samples.images());
        EXPECT_EQ(sum_of(result.clamped), 0) << n;
        EXPECT_EQ(result.images.primal(9, 9).r, 300);
    }
}

/// The limit grows with the number of samples, so the same sample is clamped at few samples only.
TEST(Fireflies, AreNotClampedAtManySamples) {
    for (const int n : {40, 4000}) {
        GradientImages images;
        images.primal = RgbImage(width, height, Rgb(1));
        images.primal(9, 9) = Rgb(1 + 100.0f / static_cast<float>(n));
        images.brightest.primal = RgbImage(width, height, Rgb(1));
        images.brightest.primal(9, 9) = Rgb(101);
        images.brightest.samples = n;
        const RgbImage removed = clamped(images).clamped;
        EXPECT_NEAR(removed(9, 9).r, std::max(101 - factor_of(n), 0.0) / n, 1e-3) << n;
        EXPECT_EQ(sum_of(removed) > 0, n == 40);
    }
}

/// Both sides of an edge have uniform noise.
TEST(Fireflies, DoNotOccurInUniformNoiseAndAtEdges) {
    for (const int n : {2, 3, 16}) {
        Samples samples(n);
        std::mt19937 random(3);
        for (RgbImage& sample : samples.passes)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    sample(x, y) =
                        Rgb((x < 20 ? 1.0f : 50.0f) * (0.8f + 0.4f * static_cast<float>(random()) / 4.3e9f));
        EXPECT_EQ(sum_of(clamped_radiance(samples.images())), 0) << n;
    }
}

/// The largest of n samples of exponential noise is about log n times their mean; the limit is a fraction of n.
TEST(Fireflies, AreFewInExponentialNoise) {
    const auto clamped_fraction = [](int n) {
        Samples samples(n);
        std::mt19937 random(5);
        std::exponential_distribution<float> noise;
        for (RgbImage& sample : samples.passes)
            for (Rgb& c : sample)
                c = Rgb(noise(random));
        const GradientImages images = samples.images();
        return sum_of(clamped_radiance(images)) / sum_of(images.primal);
    };
    EXPECT_LT(clamped_fraction(16), 0.15);
    EXPECT_LT(clamped_fraction(64), 0.01);
}

TEST(Fireflies, NeedOtherSamplesAndNoBasis) {
    GradientImages images = with_firefly_tile().images();
    EXPECT_TRUE(can_clamp(images));
    images.brightest.samples = 1;
    EXPECT_FALSE(can_clamp(images));
    images.brightest.samples = 16;
    images.components.emplace_back();
    EXPECT_FALSE(can_clamp(images));
    EXPECT_EQ(largest(clamped_radiance(images)), 0);
    images.components.clear();
    images.brightest = {};
    EXPECT_FALSE(can_clamp(images));
}

TEST(Fireflies, AreClampedToTheSameBitsWithThreads) {
    const GradientImages images = with_firefly_tile().images();
    const ClampedSamples one = clamped(images), other = clamped(images, backwards_for);
    EXPECT_TRUE(has_same_bits(one.clamped, other.clamped));
    EXPECT_TRUE(has_same_bits(one.images.dx, other.images.dx));
}

/// Clamping leaves neighbours of a pixel with black, huge or infinite samples finite.
TEST(Fireflies, LeaveFiniteSamplesFinite) {
    for (const float value : {0.0f, 1e-38f, 1e30f, std::numeric_limits<float>::infinity()}) {
        Samples samples(4);
        for (RgbImage& sample : samples.passes)
            sample(20, 20) = Rgb(value);
        samples.passes[1](5, 5) = samples.passes[1](21, 21) = Rgb(1000);
        const ClampedSamples result = clamped(samples.images());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                if (std::abs(x - 20) <= 1 && std::abs(y - 20) <= 1)
                    continue; // an infinite sample makes the means around it infinite
                EXPECT_TRUE(is_finite(result.images.primal(x, y))) << value << ": " << x << ' ' << y;
                EXPECT_TRUE(is_finite(result.clamped(x, y))) << value << ": " << x << ' ' << y;
            }
        EXPECT_LT(result.images.primal(5, 5).r, 10) << value;
    }
}

TEST(Fireflies, AreClampedByDenoisersAlone) {
    const GradientImages images = with_firefly_tile().images();
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // needs a library that may be missing
        const Reconstruction result = reconstruct(images, {.norm = norm});
        if (denoises(norm)) {
            EXPECT_LT(result.image(15, 13).r, 10) << to_string(norm);
            EXPECT_GT(result.redistributed, 0.5) << to_string(norm);
            EXPECT_NEAR(sum_of(result.image), sum_of(images.primal), 1e-3 * sum_of(images.primal))
                << to_string(norm);
        } else {
            EXPECT_EQ(result.redistributed, 0) << to_string(norm);
            if (norm != Norm::l1) {
                EXPECT_GT(result.image(15, 13).r, 20) << to_string(norm);
            }
        }
    }
}

} // namespace

} // namespace tessera::test
