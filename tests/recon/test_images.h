// Images and measures that the tests of reconstructions share.
#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/guided/joint_filter.h"
#include "recon/image.h"
#include "recon/local_brightness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

namespace tessera::test {

/// Returns an image of normally distributed channels.
inline RgbImage random_image(int width, int height, std::uint32_t seed, float mean = 0, float deviation = 1) {
    std::mt19937 engine(seed);
    std::normal_distribution<float> normal(mean, deviation);
    RgbImage image(width, height);
    for (Rgb& c : image)
        c = {normal(engine), normal(engine), normal(engine)};
    return image;
}

inline RgbImage x_differences(const RgbImage& image) {
    RgbImage result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x + 1 < image.width(); ++x)
            result(x, y) = image(x + 1, y) - image(x, y);
    return result;
}

inline RgbImage y_differences(const RgbImage& image) {
    RgbImage result(image.width(), image.height());
    for (int y = 0; y + 1 < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            result(x, y) = image(x, y + 1) - image(x, y);
    return result;
}

/// ParallelFor with two threads that run their iterations in descending order.
inline void backwards_for(int count, const std::function<void(int)>& body) {
    const auto every_second = [&](int last) {
        for (int i = last; i >= 0; i -= 2)
            body(i);
    };
    std::jthread other(every_second, count - 1);
    every_second(count - 2);
}

/// ParallelFor with a thread for each iteration.
inline void threads_for(int count, const std::function<void(int)>& body) {
    std::vector<std::jthread> threads;
    for (int i = count - 1; i >= 0; --i)
        threads.emplace_back(body, i);
}

inline glm::dvec3 mean_color(const RgbImage& image) {
    glm::dvec3 sum(0);
    for (const Rgb& c : image)
        sum += glm::dvec3(c);
    return sum / static_cast<double>(image.size());
}

/// Returns the sum of all channels of all pixels.
inline double sum_of(const RgbImage& image) {
    double sum = 0;
    for (const Rgb c : image)
        sum += static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
    return sum;
}

inline RgbImage sum_of(const RgbImage& a, const RgbImage& b) {
    RgbImage sum = a;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum.data()[i] += b.data()[i];
    return sum;
}

/// Returns the largest absolute value of a channel. NaN counts as infinite, so that no test overlooks it.
inline double largest(const RgbImage& image) {
    double result = 0;
    for (const Rgb& c : image)
        for (int channel = 0; channel < 3; ++channel) {
            const double value = std::abs(static_cast<double>(c[channel]));
            result = std::max(result, std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
        }
    return result;
}

/// Returns the smallest value of a channel. NaN counts as negative and infinite, so that no test overlooks it.
inline double smallest(const RgbImage& image) {
    double result = std::numeric_limits<double>::infinity();
    for (const Rgb& c : image)
        for (int channel = 0; channel < 3; ++channel) {
            const double value = static_cast<double>(c[channel]);
            result = std::min(result, std::isnan(value) ? -std::numeric_limits<double>::infinity() : value);
        }
    return result;
}

inline bool has_same_bits(const RgbImage& a, const RgbImage& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

/// Returns the largest difference of a channel, relative to the largest value of `expected`.
inline double relative_difference(const RgbImage& image, const RgbImage& expected) {
    RgbImage difference(image);
    for (std::size_t i = 0; i < image.size(); ++i)
        difference.data()[i] -= expected.data()[i];
    return largest(difference) / largest(expected);
}

/// Returns the root mean square difference, relative to the root mean square of `expected`.
inline double relative_rms_difference(const RgbImage& image, const RgbImage& expected) {
    double difference = 0, square = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 e(expected.data()[i]), d = glm::dvec3(image.data()[i]) - e;
        difference += glm::dot(d, d);
        square += glm::dot(e, e);
    }
    return std::sqrt(difference / square);
}

/// Returns a picture of steps and ramps, the truth of noisy_images().
inline RgbImage steps_and_ramps(int width, int height) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
    return truth;
}

/// Returns noisy samples of steps_and_ramps(), and gradients with less noise and some outliers. They have
/// variances, half differences and features that show the steps.
/// @param scale  unit of radiance
inline GradientImages noisy_images(int width, int height, float scale = 1, std::uint32_t seed = 3) {
    const RgbImage truth = steps_and_ramps(width, height);
    GradientImages images{truth, x_differences(truth), y_differences(truth), {}};
    const RgbImage noise = random_image(width, height, seed);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rgb n = noise.data()[i];
        images.primal.data()[i] += 0.1f * n;
        images.dx.data()[i] += 0.02f * Rgb(n.y, n.z, n.x) + Rgb(i % 97 == 0 ? 1.0f : 0.0f);
        images.dy.data()[i] += 0.02f * Rgb(n.z, n.x, n.y);
    }
    for (RgbImage* image : {&images.primal, &images.dx, &images.dy})
        for (Rgb& c : *image)
            c *= scale;
    // Half differences have the deviations of the noise above.
    const RgbImage half = random_image(width, height, seed + 1000, 0, scale);
    images.halves = {half, half, half};
    images.features = {RgbImage(width, height, Rgb(0.5f)), RgbImage(width, height), Image<float>(width, height, 1),
                       Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            images.halves.primal(x, y) *= 0.1f;
            images.halves.dx(x, y) *= x + 1 < width ? 0.02f : 0;
            images.halves.dy(x, y) *= y + 1 < height ? 0.02f : 0;
            images.features.normal(x, y) = (x / 10 + y / 8) % 2 == 0 ? Rgb(0, 0, 1) : Rgb(1, 0, 0);
        }
    images.primal_variance = Image<float>(width, height, 0.03f * scale * scale);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.0012f * scale * scale);
    for (std::size_t i = 0; i < truth.size(); i += 97)
        images.dx_variance.data()[i] = 3 * scale * scale;
    return images;
}

/// Adds a brightest sample to every pixel. One pixel in `stride` has a firefly, which adds 9 to its mean.
inline void add_fireflies(GradientImages& images, int samples, std::size_t stride = 211) {
    const auto n = static_cast<float>(samples);
    const int width = images.primal.width(), height = images.primal.height();
    images.brightest = {images.primal, images.dx, images.dy, {}, Image<float>(width, height, 1), samples};
    for (std::size_t i = 0; i < images.primal.size(); i += stride) {
        images.brightest.primal.data()[i] += Rgb(9 * n);
        images.primal.data()[i] += Rgb(9);
        if (!images.primal_variance.empty())
            images.primal_variance.data()[i] += 3 * 81 * images.primal_variance.data()[i];
    }
}

/// Turns images of radiance into images of a coefficient, for an albedo of vertical stripes. The samples measure
/// the albedo with noise, and the radiance has a covariance with it.
inline void demodulate(GradientImages& images, std::uint32_t seed = 7) {
    const int width = images.primal.width(), height = images.primal.height();
    const RgbImage noise = random_image(width, height, seed);
    RgbImage albedo(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            albedo(x, y) = x / 5 % 2 == 0 ? Rgb(0.7f, 0.5f, 0.3f) : Rgb(0.2f, 0.4f, 0.6f);
    RgbImage sampled = albedo, value = images.primal;
    for (std::size_t i = 0; i < value.size(); ++i) {
        sampled.data()[i] += 0.02f * noise.data()[i];
        value.data()[i] = sampled.data()[i] * images.primal.data()[i] + 0.002f * noise.data()[i];
    }
    Image<float> unexplained = images.primal_variance;
    images.demodulation = {value,
                           albedo,
                           sampled,
                           Image<float>(width, height, 0.003f),
                           Image<float>(width, height, 0.2f),
                           RgbImage(width, height, Rgb(1e-3f)),
                           RgbImage(width, height, Rgb(5e-4f)),
                           std::move(unexplained)};
    if (!images.brightest.empty())
        images.brightest.albedo = sampled;
    images.features.albedo = albedo;
}

/// Returns the local mean brightness of a picture over its albedo, reconstruction (42).
inline Image<float> local_brightness_of(const RgbImage& picture, const FeatureImages& features,
                                        const GuidedParameters& parameters = {},
                                        const ParallelFor& parallel_for = serial_for) {
    Image<float> light(picture.width(), picture.height());
    for (std::size_t i = 0; i < light.size(); ++i)
        light.data()[i] = brightness_of(picture.data()[i] / feature_albedo(features, i, parameters.least_albedo));
    return local_mean_brightness(std::move(light), parameters.local_radius, parallel_for);
}

/// Filters a picture and its noise with stages 6 and 7 of the denoiser.
inline NoisyPicture filtered_with_noise(NoisyPicture picture, const FeatureImages& features,
                                        const ParallelFor& parallel_for = serial_for,
                                        const GuidedParameters& parameters = {}) {
    const FeatureKernels kernels({picture.image.width(), picture.image.height()}, features, parameters,
                                 parallel_for);
    const Image<float> local = local_brightness_of(picture.image, features, parameters, parallel_for);
    FilterFit fit;
    return filter(std::move(picture), features, kernels, local, parameters, fit, parallel_for);
}

} // namespace tessera::test
