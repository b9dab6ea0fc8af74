// Pictures as planes, one for each channel, on which smoothing by guides works (recon/picture/guided.h): of light,
// as what a texture does to it is known, and of the radiance that becomes of it.
#pragma once

#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>

namespace tessera {

/// Three channels of a picture, or these and three of its noise, each for itself.
using Planes = std::array<Plane, 3>;
using NoisyPlanes = std::array<Plane, 6>;

/// Planes of nothing.
template <class AnyPlanes>
AnyPlanes black_planes(int width, int height, const ParallelFor& parallel_for) {
    AnyPlanes planes;
    for (Plane& plane : planes)
        plane = filled_image(width, height, 0.0f, parallel_for);
    return planes;
}

/// The light of a picture, or first of it and then of its noise: radiance over what is seen takes of it.
template <class AnyPlanes>
void write_light(const RgbImage& radiance, const GuideImages& guides, std::size_t first,
                 const ParallelFor& parallel_for, AnyPlanes& planes) {
    for_pixels(radiance.width(), radiance.height(), parallel_for, [&](std::size_t i) {
        const Rgb light = light_at(radiance, guides, i);
        for (std::size_t c = 0; c < 3; ++c)
            planes[first + c].data()[i] = light[static_cast<int>(c)];
    });
}

/// The mean of the channels of a picture, or of its noise, at pixel i.
template <class AnyPlanes>
float mean_of(const AnyPlanes& planes, std::size_t first, std::size_t i) {
    return (planes[first].data()[i] + planes[first + 1].data()[i] + planes[first + 2].data()[i]) / 3;
}

/// The brightness of pixel i, and a little of the picture's.
template <class AnyPlanes>
float brightness_at(const AnyPlanes& planes, float least, std::size_t i) {
    return std::max(mean_of(planes, 0, i), 0.0f) + least;
}

/// What the brightness of any pixel counts as more; 0: there is as good as no light.
template <class AnyPlanes>
float least_brightness(const AnyPlanes& light, const ParallelFor& parallel_for) {
    const double sum = sum_over_pixels(light[0].width(), light[0].height(), parallel_for,
                                       [&](std::size_t i) { return std::max(0.0f, mean_of(light, 0, i)); });
    const float least = dark * static_cast<float>(sum / static_cast<double>(light[0].size()));
    return least < std::numeric_limits<float>::min() ? 0 : least;
}

/// Adds c (finer - coarser) to the sum, which may be `coarser` itself.
template <class AnyPlanes>
void add_difference(const Plane& trust, const AnyPlanes& finer, const AnyPlanes& coarser,
                    const ParallelFor& parallel_for, AnyPlanes& sum) {
    const int width = trust.width();
    parallel_for(trust.height(), [&](int y) {
        for (std::size_t c = 0; c < sum.size(); ++c)
            for (int x = 0; x < width; ++x)
                sum[c](x, y) += trust(x, y) * (finer[c](x, y) - coarser[c](x, y));
    });
}

/// Makes differences, and the light that they are differences to, the radiance of their sum.
template <class AnyPlanes>
void make_radiance(const AnyPlanes& light, const GuideImages& guides, const ParallelFor& parallel_for,
                   AnyPlanes& differences) {
    for_pixels(light[0].width(), light[0].height(), parallel_for, [&](std::size_t i) {
        const Rgb albedo = seen_albedo(guides, i);
        for (std::size_t c = 0; c < light.size(); ++c) {
            float& value = differences[c].data()[i];
            value = (value + light[c].data()[i]) * albedo[static_cast<int>(c % 3)];
        }
    });
}

/// One over the square of the brightness around each pixel, so that errors count beside it. Around, as pixels that
/// noise makes dark would else count more, and the picture would be darker.
template <class AnyPlanes>
void write_relative_weights(const AnyPlanes& radiance, float least, const ParallelFor& parallel_for, Plane& rows,
                            Plane& weights) {
    for_pixels(weights.width(), weights.height(), parallel_for,
               [&](std::size_t i) { weights.data()[i] = brightness_at(radiance, least, i); });
    constexpr int radius = 2; // of the squares of the regression
    take_wide_means(weights, radius, rows, parallel_for);
    for_pixels(weights.width(), weights.height(), parallel_for, [&](std::size_t i) {
        float& weight = weights.data()[i]; // at most 1, so that sums of them are numbers
        weight = (least / weight) * (least / weight);
    });
}

/// Where a difference that stays stands on one that goes, a dark pixel may come out below black: not below what it
/// was.
template <class AnyPlanes>
void write_picture(const AnyPlanes& radiance, const ParallelFor& parallel_for, RgbImage& image) {
    for_pixels(image.width(), image.height(), parallel_for, [&](std::size_t i) {
        Rgb& colour = image.data()[i];
        const Rgb least = glm::min(colour, Rgb(0));
        for (std::size_t c = 0; c < 3; ++c) {
            const auto channel = static_cast<int>(c);
            colour[channel] = std::max(radiance[c].data()[i], least[channel]);
        }
    });
}

inline void write_noise(const NoisyPlanes& radiance, const ParallelFor& parallel_for, RgbImage& noise) {
    for_pixels(noise.width(), noise.height(), parallel_for, [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c)
            noise.data()[i][static_cast<int>(c)] = radiance[c + 3].data()[i];
    });
}

} // namespace tessera
