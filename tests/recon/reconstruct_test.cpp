// reconstruct() with all solvers of raw samples: exact and invalid inputs, units, progress and errors.
#include "recon/picture/reconstruct.h"
#include "recon/solvers/poisson_weighted.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using namespace test;

constexpr Norm solved[] = {Norm::l2, Norm::l1, Norm::mixed, Norm::uniform, Norm::weighted};

TEST(Reconstruct, WithoutGradientsIsThePrimalPlusDirectlyVisibleEmission) {
    GradientImages images{RgbImage(5, 4, Rgb(1)), {}, {}, RgbImage(5, 4, Rgb(2))};
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // needs a library that may be missing
        EXPECT_EQ(reconstruct(images, {norm, 0.2f}).image(3, 2), Rgb(3));
    }
    images.very_direct = {};
    EXPECT_EQ(reconstruct(images, {}).image(3, 2), Rgb(1));
}

TEST(Reconstruct, AddsDirectlyVisibleEmissionAfterTheSolver) {
    GradientImages images = noisy_images(40, 30);
    for (const Norm norm : solved) {
        images.very_direct = {};
        const RgbImage without = reconstruct(images, {norm, 0.2f}).image;
        images.very_direct = RgbImage(40, 30);
        images.very_direct(7, 9) = Rgb(100);
        const RgbImage with = reconstruct(images, {norm, 0.2f}).image;
        EXPECT_EQ(with(7, 9), without(7, 9) + Rgb(100));
        EXPECT_EQ(with(8, 9), without(8, 9));
    }
}

TEST(Reconstruct, ReturnsTheImageOfExactGradients) {
    const RgbImage image = random_image(37, 23, 9, 2, 0.5f);
    const GradientImages images{image, x_differences(image), y_differences(image), {}};
    for (const Norm norm : all_norms) {
        if (norm == Norm::oidn)
            continue; // needs a library that may be missing
        const Reconstruction result = reconstruct(images, {norm, 0.2f});
        EXPECT_LE(relative_difference(result.image, image), 1e-5) << to_string(norm);
    }
}

TEST(Reconstruct, ReturnsTheImageOfExactGradientsForAnyWeights) {
    const RgbImage image = random_image(37, 23, 9, 2, 0.5f);
    GradientImages images{image, x_differences(image), y_differences(image), {}};
    const RgbImage noise = random_image(37, 23, 10);
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(37, 23);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        images.primal_variance.data()[i] = std::exp(2 * noise.data()[i].x);
        images.dx_variance.data()[i] = i % 5 == 0 ? 0 : std::exp(4 * noise.data()[i].y);
        images.dy_variance.data()[i] = i % 7 == 0 ? 1e30f : std::exp(4 * noise.data()[i].z);
    }
    EXPECT_LE(relative_rms_difference(reconstruct(images, {Norm::weighted, 0.2f}).image, image), 2e-2);
}

/// A plane with a noisy primal and no variances, as after one sample. Exact gradients have the weights of `l2`,
/// and outliers have smaller ones.
TEST(Reconstruct, WithoutVariancesMistrustsOutliersOfGradients) {
    RgbImage plane(40, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            plane(x, y) = Rgb(5, 6, 7) + 0.05f * static_cast<float>(x) + 0.02f * static_cast<float>(y);
    GradientImages images{plane, x_differences(plane), y_differences(plane), {}};
    const RgbImage noise = random_image(40, 30, 5);
    for (std::size_t i = 0; i < noise.size(); ++i)
        images.primal.data()[i] += noise.data()[i];
    images.primal_variance = Image<float>(40, 30, 1.0f); // a variance of the primal alone is not used
    const auto image = [&](Norm norm, float alpha) { return reconstruct(images, {norm, alpha}).image; };
    const float alpha = 0.2f / GuidedParameters().alpha_scale; // reconstruction (39) gives a = 0.2
    EXPECT_LE(relative_difference(image(Norm::weighted, alpha), image(Norm::l2, 0.2f)), 1e-2);
    for (std::size_t i = 0; i < noise.size(); i += 97)
        images.dx.data()[i] += 5.0f;
    EXPECT_LE(relative_rms_difference(image(Norm::weighted, alpha), plane),
              0.5 * relative_rms_difference(image(Norm::l2, 0.2f), plane));
}

/// The first picture has no variances, so its weights differ from those of the second.
TEST(Reconstruct, WarmStartsFollowTheFirstVariances) {
    const GradientImages second = noisy_images(40, 30);
    GradientImages first = noisy_images(40, 30, 1, 4);
    first.primal_variance = first.dx_variance = first.dy_variance = {};
    Reconstructor reconstructor;
    reconstructor.reconstruct(first, {Norm::weighted, 0.2f});
    const RgbImage image = reconstructor.reconstruct(second, {Norm::weighted, 0.2f}).image;
    EXPECT_LT(relative_rms_difference(image, reconstruct(second, {Norm::weighted, 0.2f}).image), 0.01);
}

/// A dark window frame with little noise beside bright panes with much noise, which the frame must not take over.
TEST(Reconstruct, KeepsDarkPixelsDarkBesideNoisyOnes) {
    constexpr int width = 60, height = 40, frame_begin = 26, frame_end = 34;
    const auto in_frame = [](int x) { return x >= frame_begin && x < frame_end; };
    const RgbImage noise = random_image(width, height, 3, 0, 1);
    GradientImages images{RgbImage(width, height), {}, {}, {}};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(width, height, 1e-8f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            images.primal(x, y) = in_frame(x) ? Rgb(0.01f) : Rgb(3) + noise(x, y);
            if (in_frame(x))
                continue;
            images.primal_variance(x, y) = images.dy_variance(x, y) = images.dx_variance(x, y) = 3;
            if (x > 0)
                images.dx_variance(x - 1, y) = 3;
        }
    const RgbImage gradient_noise = random_image(width, height, 4, 0, 1); // independent of the primal's
    RgbImage noisy = images.primal;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (!in_frame(x))
                noisy(x, y) = Rgb(3) + gradient_noise(x, y);
    images.dx = x_differences(noisy);
    images.dy = y_differences(noisy);
    const RgbImage image = reconstruct(images, {Norm::weighted, 0.2f}).image;
    for (int y = 0; y < height; ++y)
        for (int x = frame_begin + 1; x + 1 < frame_end; ++x)
            EXPECT_LE(std::abs(image(x, y).g - 0.01f), 0.05f) << x << " " << y;
    // Solvers may go below black there; `guided` may not.
    EXPECT_GE(smallest(reconstruct(images, {Norm::guided, 0.2f}).image), 0);
}

TEST(Reconstruct, MeasuresTheResidualOfL2) {
    const Reconstruction result = reconstruct(noisy_images(61, 33), {Norm::l2, 0.2f});
    EXPECT_EQ(result.iterations, 1);
    EXPECT_GT(result.residual, 0);
    EXPECT_LT(result.residual, 1e-6);
}

TEST(Reconstruct, IsIndependentOfTheUnitOfRadiance) {
    for (const bool has_variances : {true, false}) {
        const auto image_in = [&](float scale, Norm norm) {
            GradientImages images = noisy_images(50, 41, scale);
            if (!has_variances)
                images.primal_variance = images.dx_variance = images.dy_variance = {};
            RgbImage image = reconstruct(images, {norm, 0.2f}).image;
            for (Rgb& c : image)
                c /= scale;
            return image;
        };
        for (const Norm norm : solved)
            for (const float scale : {1e-4f, 1e4f})
                EXPECT_LE(relative_difference(image_in(scale, norm), image_in(1, norm)), 1e-4)
                    << to_string(norm) << " " << scale << " " << has_variances;
    }
}

TEST(Reconstruct, IsFiniteForBlackImagesAndOutliers) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 30}, {30, 1}, {23, 19}}) {
        GradientImages images{RgbImage(width, height), RgbImage(width, height), RgbImage(width, height), {}};
        for (const float outlier : {0.0f, 1e6f}) {
            images.primal(width / 2, height / 2) = Rgb(outlier);
            images.dx(0, 0) = Rgb(-outlier);
            for (Image<float>* variance : {&images.primal_variance, &images.dx_variance, &images.dy_variance})
                *variance = Image<float>(width, height);
            images.dx_variance(0, 0) = outlier == 0 ? 0 : std::numeric_limits<float>::max();
            for (const Norm norm : solved)
                EXPECT_TRUE(std::isfinite(largest(reconstruct(images, {norm, 0.2f}).image)));
            images.primal_variance = {};
            EXPECT_TRUE(std::isfinite(largest(reconstruct(images, {Norm::weighted, 0.2f}).image)));
        }
    }
}

TEST(Reconstruct, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    const GradientImages images = noisy_images(20, 20);
    for (const Norm norm : solved)
        EXPECT_TRUE(reconstruct(images, {norm, 0.2f}, serial_for, source.get_token()).image.empty());
}

TEST(Reconstruct, ReportsItsProgress) {
    const GradientImages images = noisy_images(20, 20);
    for (const Norm norm : {Norm::l1, Norm::mixed, Norm::weighted, Norm::uniform}) {
        std::atomic<float> progress = 0;
        std::vector<float> seen;
        const ParallelFor watched = [&](int count, const std::function<void(int)>& work) {
            seen.push_back(progress);
            serial_for(count, work);
        };
        reconstruct(images, {norm, 0.2f}, watched, {{}, &progress});
        EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end())) << to_string(norm);
        const int steps = norm == Norm::weighted ? WeightedSettings{}.cold_iterations : 11;
        EXPECT_GE(std::set<float>(seen.begin(), seen.end()).size(), static_cast<std::size_t>(steps))
            << to_string(norm);
        EXPECT_EQ(seen.front(), 0) << to_string(norm);
        // The weighted solver ends early where its residual is 0.
        EXPECT_GE(seen.back(), norm == Norm::weighted ? 0.5f : 1 - 1.0f / static_cast<float>(steps))
            << to_string(norm);
        EXPECT_LT(seen.back(), 1) << to_string(norm);
    }
}

TEST(Reconstruct, RejectsInvalidArguments) {
    GradientImages images = noisy_images(20, 20);
    EXPECT_THROW(reconstruct(images, {Norm::l2, 0.0f}), std::invalid_argument);
    EXPECT_THROW(reconstruct(images, {Norm::l2, NAN}), std::invalid_argument);
    images.dx = RgbImage(20, 21);
    EXPECT_THROW(reconstruct(images, {Norm::l2, 0.2f}), std::invalid_argument);
}

} // namespace
} // namespace tessera
