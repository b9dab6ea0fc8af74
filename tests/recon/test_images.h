#pragma once

#include "recon/image.h"
#include "recon/picture/guide_kernel.h"
#include "recon/picture/guided.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <utility>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

namespace tessera::test {

/// Normally distributed channels.
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

/// A ParallelFor of two threads, which take their iterations backwards.
inline void backwards_for(int count, const std::function<void(int)>& body) {
    const auto every_second = [&](int last) {
        for (int i = last; i >= 0; i -= 2)
            body(i);
    };
    std::jthread other(every_second, count - 1);
    every_second(count - 2);
}

inline glm::dvec3 mean_color(const RgbImage& image) {
    glm::dvec3 sum(0);
    for (const Rgb& c : image)
        sum += glm::dvec3(c);
    return sum / static_cast<double>(image.size());
}

/// Absolute, of all channels; NaN counts as infinite, so that no test takes it for nothing.
inline double largest(const RgbImage& image) {
    double result = 0;
    for (const Rgb& c : image)
        for (int channel = 0; channel < 3; ++channel) {
            const double value = std::abs(static_cast<double>(c[channel]));
            result = std::max(result, std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
        }
    return result;
}

/// The largest difference of a channel, relative to the largest value of `expected`.
inline double relative_difference(const RgbImage& image, const RgbImage& expected) {
    RgbImage difference(image);
    for (std::size_t i = 0; i < image.size(); ++i)
        difference.data()[i] -= expected.data()[i];
    return largest(difference) / largest(expected);
}

/// The root mean square difference, relative to the root mean square of `expected`.
inline double relative_rms_difference(const RgbImage& image, const RgbImage& expected) {
    double difference = 0, square = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 e(expected.data()[i]), d = glm::dvec3(image.data()[i]) - e;
        difference += glm::dot(d, d);
        square += glm::dot(e, e);
    }
    return std::sqrt(difference / square);
}

/// Steps and ramps with noise, and gradients with less noise but some outliers; with variances, halves and guides
/// that tell.
inline GradientImages noisy_images(int width, int height, float scale = 1, std::uint32_t seed = 3) {
    RgbImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            truth(x, y) = Rgb((x / 10 + y / 8) % 2 == 0 ? 0.9f : 0.2f, 0.4f, 0.1f + 0.01f * static_cast<float>(y));
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
    // Halves that differ as means of such noise do; and guides that see the steps.
    const RgbImage half = random_image(width, height, seed + 1000, 0, scale);
    images.halves = {half, half, half};
    images.guides = {RgbImage(width, height, Rgb(0.5f)), RgbImage(width, height), Image<float>(width, height, 1),
                     Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            images.halves.primal(x, y) *= 0.1f;
            images.halves.dx(x, y) *= x + 1 < width ? 0.02f : 0;
            images.halves.dy(x, y) *= y + 1 < height ? 0.02f : 0;
            images.guides.normal(x, y) = (x / 10 + y / 8) % 2 == 0 ? Rgb(0, 0, 1) : Rgb(1, 0, 0);
        }
    images.primal_variance = Image<float>(width, height, 0.03f * scale * scale);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 0.0012f * scale * scale);
    for (std::size_t i = 0; i < truth.size(); i += 97)
        images.dx_variance.data()[i] = 3 * scale * scale;
    return images;
}

/// Of all channels of all pixels.
inline double sum_of(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
    return sum;
}

/// A picture smoothed by guides (recon/picture/guided.h), and what is left of its noise.
inline NoisyPicture smoothed_with_noise(NoisyPicture picture, const GuideImages& guides,
                                        const ParallelFor& parallel_for = serial_for) {
    const AlikePixels alike({picture.image.width(), picture.image.height()}, guides, parallel_for);
    return smooth_by_guides(std::move(picture), guides, alike, parallel_for);
}

/// Pixels that all look alike.
inline AlikePixels anywhere(const RgbImage& image) {
    return {{image.width(), image.height()}, {}, serial_for};
}

} // namespace tessera::test
