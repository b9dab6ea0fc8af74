#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <algorithm>

#include <glm/common.hpp>

namespace tessera {

/// Albedo of what pixel i sees first, at least `least`; 1 without features. Radiance over it is about irradiance.
inline Rgb seen_albedo(const FeatureImages& features, std::size_t i, float least) {
    return features.empty() ? Rgb(1) : glm::max(features.albedo.data()[i], Rgb(least));
}

/// Brightness of light: the mean of its channels, >= 0.
inline float brightness_of(Rgb light) {
    return std::max((light.r + light.g + light.b) / 3, 0.0f);
}

/// Mean brightness around each pixel, > 0: the unit of what counts as dark. Means of means over squares of the
/// given radius, so that the result depends on pixels within twice the radius only, and not on the frame.
/// @param brightness  >= 0; values beyond 1e20 count as 1e20
Image<float> local_mean_brightness(Image<float> brightness, int radius, const ParallelFor& parallel_for);

} // namespace tessera
