// Pictures as planes, one for each channel, for the filter and the regression.
#pragma once

#include "recon/guided/kernel_sums.h"
#include "recon/local_brightness.h"
#include "recon/parallel.h"
#include "recon/pixel_loops.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tessera {

/// Three channels of a picture; NoisyPlanes has three channels of its noise N after them.
using Planes = std::array<Plane, 3>;
using NoisyPlanes = std::array<Plane, 6>;

/// Picture and its noise N, reconstruction (41). Empty noise: unknown.
struct NoisyPicture {
    RgbImage image, noise;
};

template <class AnyPlanes>
AnyPlanes black_planes(int width, int height, const ParallelFor& parallel_for) {
    AnyPlanes planes;
    for (Plane& plane : planes)
        plane = filled_image(width, height, 0.0f, parallel_for);
    return planes;
}

/// Writes radiance / albedo to three planes from `first` on.
template <class AnyPlanes>
void write_light(const RgbImage& radiance, const FeatureImages& features, float least_albedo, std::size_t first,
                 const ParallelFor& parallel_for, AnyPlanes& planes) {
    for_pixels(radiance.width(), radiance.height(), parallel_for, [&](std::size_t i) {
        const Rgb light = radiance.data()[i] / feature_albedo(features, i, least_albedo);
        for (int c = 0; c < 3; ++c)
            planes[first + c].data()[i] = light[c];
    });
}

/// Returns the mean of three channels at pixel i, of the picture (first = 0) or of its noise (first = 3).
template <class AnyPlanes>
float mean_of(const AnyPlanes& planes, std::size_t first, std::size_t i) {
    return (planes[first].data()[i] + planes[first + 1].data()[i] + planes[first + 2].data()[i]) / 3;
}

/// Returns the brightness of pixel i plus `dark`.
template <class AnyPlanes>
float brightness_at(const AnyPlanes& planes, float dark, std::size_t i) {
    return std::max(mean_of(planes, 0, i), 0.0f) + dark;
}

/// Adds trust (finer - coarser) to `sum`, reconstruction (51). `sum` may be `coarser` itself.
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

/// Copies three planes from `first` on to an image.
template <class AnyPlanes>
void write_image(const AnyPlanes& planes, std::size_t first, const ParallelFor& parallel_for, RgbImage& image) {
    for_pixels(image.width(), image.height(), parallel_for, [&](std::size_t i) {
        for (int c = 0; c < 3; ++c)
            image.data()[i][c] = planes[first + c].data()[i];
    });
}

} // namespace tessera
