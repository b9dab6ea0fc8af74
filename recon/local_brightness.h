#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <algorithm>

#include <glm/common.hpp>

namespace tessera {

/// Returns the feature albedo of pixel i, at least `least`; 1 without features. Radiance / albedo is like
/// irradiance.
inline Rgb feature_albedo(const FeatureImages& features, std::size_t i, float least) {
    return features.empty() ? Rgb(1) : glm::max(features.albedo.data()[i], Rgb(least));
}

/// Returns the brightness: the mean of the channels, >= 0.
inline float brightness_of(Rgb light) {
    return std::max((light.r + light.g + light.b) / 3, 0.0f);
}

/// Returns L of reconstruction (42), the mean brightness around each pixel, > 0: the unit of what counts as dark.
/// It is a mean over squares of the given radius, taken twice, so that it depends only on pixels within twice the
/// radius and not on the frame.
/// @param brightness  >= 0; NaN and values above 1e20 count as 1e20
Image<float> local_mean_brightness(Image<float> brightness, int radius, const ParallelFor& parallel_for);

} // namespace tessera
