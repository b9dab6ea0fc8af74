// Pictures of `guided` and `smoothed`: their errors and energy, also for inputs with missing images or invalid
// values.
#include "recon/guided/guided.h"
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int width = 64, height = 48;
constexpr Norm both[] = {Norm::guided, Norm::smoothed};

/// Returns all images that the stages read.
GradientImages full_images(bool is_demodulated) {
    GradientImages images = noisy_images(width, height);
    images.patch = 4;
    add_fireflies(images, 16);
    if (is_demodulated)
        demodulate(images);
    return images;
}

RgbImage picture_of(const GradientImages& images, Norm norm, const GuidedStages& stages = {},
                    const ParallelFor& parallel_for = serial_for) {
    Reconstructor reconstructor;
    GuidedParameters parameters;
    parameters.stages = stages;
    reconstructor.set_parameters(parameters);
    return reconstructor.reconstruct(images, {norm}, parallel_for).image;
}

TEST(Guided, HasTheSameBitsWithThreads) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : both) {
            const GradientImages images = full_images(is_demodulated);
            EXPECT_TRUE(has_same_bits(picture_of(images, norm), picture_of(images, norm, {}, backwards_for)))
                << to_string(norm) << " " << is_demodulated;
        }
}

TEST(Guided, IsIndependentOfTheUnitOfRadiance) {
    for (const Norm norm : both)
        for (const float scale : {1e-4f, 1024.0f}) {
            RgbImage scaled = reconstruct(noisy_images(width, height, scale), {norm}).image;
            for (Rgb& c : scaled)
                c /= scale;
            EXPECT_LT(relative_difference(scaled, reconstruct(noisy_images(width, height), {norm}).image), 0.02)
                << to_string(norm) << " " << scale;
        }
}

TEST(Guided, HasASmallerErrorThanItsInputs) {
    const RgbImage truth = steps_and_ramps(width, height);
    const GradientImages images = noisy_images(width, height);
    const auto error = [&](Norm norm) {
        return relative_rms_difference(reconstruct(images, {norm}).image, truth);
    };
    EXPECT_LT(error(Norm::guided), 0.9 * error(Norm::weighted));
    EXPECT_LT(error(Norm::smoothed), 0.5 * error(Norm::none));
}

/// The error vanishes with the noise.
TEST(Guided, IsConsistent) {
    const RgbImage truth = steps_and_ramps(width, height);
    for (const Norm norm : both) {
        double last = 1;
        for (const float noise : {1.0f, 0.1f, 0.01f}) {
            GradientImages images = noisy_images(width, height);
            const auto draw = [&](RgbImage& image, const RgbImage& exact) {
                for (std::size_t i = 0; i < image.size(); ++i)
                    image.data()[i] = exact.data()[i] + noise * (image.data()[i] - exact.data()[i]);
            };
            draw(images.primal, truth);
            draw(images.dx, x_differences(truth));
            draw(images.dy, y_differences(truth));
            for (RgbImage* half : {&images.halves.primal, &images.halves.dx, &images.halves.dy})
                for (Rgb& c : *half)
                    c *= noise;
            for (Image<float>* variances : {&images.primal_variance, &images.dx_variance, &images.dy_variance})
                for (float& v : *variances)
                    v *= noise * noise;
            const double error = relative_rms_difference(reconstruct(images, {norm}).image, truth);
            EXPECT_LT(error, 0.3 * last) << to_string(norm) << " " << noise;
            last = error;
        }
    }
}

/// Fireflies have half of the energy. The picture keeps all of it up to a few percent, apart from the bounds: here
/// only the pixels of the fireflies have found their light.
TEST(Guided, KeepsTheEnergyOfFireflies) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : both) {
            GradientImages images = noisy_images(width, height);
            images.patch = 4;
            add_fireflies(images, 16, 20);
            if (is_demodulated)
                demodulate(images);
            GuidedParameters parameters;
            parameters.stages.bounds = false;
            Reconstructor reconstructor;
            reconstructor.set_parameters(parameters);
            const Reconstruction result = reconstructor.reconstruct(images, {norm});
            EXPECT_GT(result.redistributed, 0.3) << to_string(norm);
            EXPECT_NEAR(sum_of(result.image), sum_of(images.radiance()), 0.05 * sum_of(images.radiance()))
                << to_string(norm) << " " << is_demodulated;
            EXPECT_LT(largest(result.image), 0.6 * largest(images.radiance())) << to_string(norm);
        }
}

/// Pictures of non-negative samples are not negative.
TEST(Guided, MakesNothingNegative) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : both) {
            GradientImages images = full_images(is_demodulated);
            for (RgbImage* image : {&images.primal, &images.brightest.primal, &images.demodulation.value})
                for (Rgb& c : *image)
                    c = glm::max(c, Rgb(0));
            EXPECT_GE(smallest(reconstruct(images, {norm}).image), 0) << to_string(norm) << " " << is_demodulated;
        }
}

/// Benches switch off one stage at a time.
TEST(Guided, IsFiniteWithoutAnyOneStage) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : both)
            for (const auto stage :
                 {&GuidedStages::fireflies, &GuidedStages::edge_weights, &GuidedStages::covariance,
                  &GuidedStages::redistribution, &GuidedStages::filter, &GuidedStages::regression}) {
                GuidedStages stages;
                stages.*stage = false;
                EXPECT_TRUE(std::isfinite(largest(picture_of(full_images(is_demodulated), norm, stages))))
                    << to_string(norm) << " " << is_demodulated;
            }
}

TEST(Guided, OfBlackSamplesIsBlack) {
    for (const bool is_demodulated : {false, true})
        for (const Norm norm : both) {
            GradientImages images = full_images(is_demodulated);
            for (RgbImage* image :
                 {&images.primal, &images.dx, &images.dy, &images.brightest.primal, &images.brightest.dx,
                  &images.brightest.dy, &images.halves.primal, &images.halves.dx, &images.halves.dy,
                  &images.demodulation.value, &images.demodulation.value_covariance})
                for (Rgb& c : *image)
                    c = Rgb(0);
            for (Image<float>* variances : {&images.primal_variance, &images.dx_variance, &images.dy_variance,
                                            &images.demodulation.unexplained_variance})
                for (float& v : *variances)
                    v = 0;
            EXPECT_EQ(largest(reconstruct(images, {norm}).image), 0) << to_string(norm) << " " << is_demodulated;
        }
}

/// One pixel is infinite; others have fireflies.
TEST(Guided, OfAnInfiniteSampleIsFiniteElsewhere) {
    for (const bool is_demodulated : {false, true}) {
        GradientImages images = full_images(is_demodulated);
        constexpr float infinity = std::numeric_limits<float>::infinity();
        images.primal(20, 20) = Rgb(infinity);
        if (is_demodulated)
            images.demodulation.value(20, 20) = Rgb(infinity);
        const RgbImage picture = reconstruct(images, {Norm::smoothed}).image;
        int invalid = 0;
        for (const Rgb c : picture)
            invalid += !is_finite(c);
        EXPECT_LE(invalid, 300) << is_demodulated; // of 3072
    }
}

TEST(Guided, OfPicturesOfAnySizeIsFinite) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {17, 5}}) {
        GradientImages images = noisy_images(w, h);
        add_fireflies(images, 16);
        images.patch = 4;
        for (const Norm norm : both)
            EXPECT_TRUE(std::isfinite(largest(reconstruct(images, {norm}).image))) << w << "x" << h;
    }
}

/// A dark bar without noise in front of a bright and noisy sky. No feature shows the bar.
TEST(Guided, KeepsADarkBarDark) {
    constexpr int bar = 46;
    const auto noise_in_tiles = [](std::uint32_t seed) {
        const RgbImage values = random_image(width, height, seed, 0, 0.3f);
        RgbImage tiles(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                tiles(x, y) = values(x / 6, y / 6);
        return tiles;
    };
    GradientImages images;
    images.primal = sum_of(RgbImage(width, height, Rgb(1)), noise_in_tiles(3));
    images.halves.primal = noise_in_tiles(4);
    images.primal_variance = Image<float>(width, height, 3 * 0.09f);
    images.features = {RgbImage(width, height, Rgb(0.5f)), RgbImage(width, height, Rgb(0, 0, 1)),
                       Image<float>(width, height, 1), Image<float>(width, height, 0.1f)};
    images.patch = 6;
    for (int y = 0; y < height; ++y)
        for (int x = bar; x < bar + 3; ++x) {
            images.primal(x, y) = Rgb(0.01f);
            images.halves.primal(x, y) = Rgb(1e-4f);
            images.primal_variance(x, y) = 3e-8f;
        }
    const RgbImage picture = reconstruct(images, {Norm::smoothed}).image;
    for (int y = 0; y < height; ++y)
        ASSERT_LT(picture(bar + 1, y).g, 0.05f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_color(picture)[c], mean_color(images.primal)[c], 0.02);
}

/// There are no half differences after one sample, and files may have no features. `guided` is then `weighted`.
TEST(Guided, WithoutHalvesOrFeaturesIsWeighted) {
    for (const bool has_halves : {false, true}) {
        GradientImages images = noisy_images(40, 30);
        if (has_halves)
            images.features = {};
        else
            images.halves = {};
        const RgbImage guided = reconstruct(images, {Norm::guided}).image;
        // `weighted` takes more steps.
        EXPECT_LT(relative_difference(guided, reconstruct(images, {Norm::weighted}).image), 5e-3);
    }
}

} // namespace

} // namespace tessera::test
