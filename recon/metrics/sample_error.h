#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"

#include <optional>

namespace tessera {

/// How far the samples are from the truth without a reference, by what halves of them disagree on: an estimate of
/// the relative_mse of their mean, spikes in full, as Norm::none with Spikes::off shows it,
///     mean of h^2 / (m^2 + epsilon) .
/// h are the half differences, as radiance; m are means of the picture over 5x5 pixels, as what a pixel's own
/// samples say of its brightness goes with their noise. It sees no bias, but samples have none. Emission that the
/// camera sees counts as brightness alone: noise at edges of lamps is not in it.
/// @param picture  the best that there is of the same view and size
/// Empty: the halves are unknown, or it is not known yet how bright the picture is: the halves disagree on more
/// than a fifth of the squared means.
std::optional<FloorFreeError> estimate_sample_error(const GradientImages& images, const RgbImage& picture);

} // namespace tessera
