#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"

#include <optional>

namespace tessera {

/// Estimates the error of the raw samples without a reference, from the disagreement of their two halves: the
/// relative_mse of their mean, as Norm::none shows it,
///     mean of h^2 / (m^2 + epsilon) .
/// h are the half differences, as radiance; m are means of the picture over 5x5 pixels, since the brightness of a
/// single pixel's samples correlates with their noise. The estimate contains no bias; raw samples have none. Directly
/// visible emission adds to the brightness alone: noise at edges of lamps is not in the estimate.
/// @param picture  the best picture of the same view and size
/// @returns empty where the halves are unknown, or disagree on more than a fifth of the squared means.
std::optional<FloorFreeError> estimate_sample_error(const GradientImages& images, const RgbImage& picture);

} // namespace tessera
