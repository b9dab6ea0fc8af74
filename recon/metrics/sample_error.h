#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"

#include <optional>

namespace tessera {

/// Estimates the relative MSE of the raw samples (Norm::none) without a reference, from their half differences h,
///     mean of h^2 / (m^2 + epsilon) ,
/// with h as radiance. m are means of the picture over 5x5 pixels, since the brightness of a single pixel's
/// samples correlates with their noise. Raw samples have no bias. Directly visible emission adds to the brightness
/// alone, so that noise at edges of lamps is not in the estimate.
/// @param picture  the best known picture of the same view and size
/// @returns empty if the halves are unknown, or disagree on more than a fifth of the squared means
std::optional<FloorFreeError> estimate_sample_error(const GradientImages& images, const RgbImage& picture);

} // namespace tessera
