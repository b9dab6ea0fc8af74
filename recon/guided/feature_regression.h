#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/parallel.h"

#include <cstddef>
#include <span>

namespace tessera {

// Regression of radiance on features, reconstruction (53). A pixel at an edge shows fractions of both sides, and
// no pixel nearby has similar features, so that kernels leave it its noise. Radiance and the means of albedo,
// normal, depth and roughness are about linear in these fractions. In squares of 5x5 pixels, radiance is therefore
// fitted by a first-order function of the features f [Bitterli 2016],
//     minimise over a, s   sum over q of w_q (x_q - a - s . (f_q - f_p))^2 ,
// and pixel p becomes a. A ridge draws the slopes s to 0, so that there is always a solution. The result is linear
// in the values x, so that the same map applies to their noise.

inline constexpr std::size_t most_regressed = 6; ///< largest number of planes in one call

/// Writes a of all pixels, for each plane of values. Pixels keep their values where features are not finite, or
/// too large to be squared. Throws std::invalid_argument for more than most_regressed planes, or another number of
/// results.
/// @param weights  w of each pixel, > 0 and at most 1; ratios within a square at most 1e14
/// @param ridge    weight of the squared slopes, relative to the sum of the square's weights
/// @param fitted   one plane for each of values, of the picture's size, any content
void write_regressions(std::span<const Plane> values, const FeaturePlanes& features, const Plane& weights,
                       float ridge, const ParallelFor& parallel_for, std::span<Plane> fitted);

} // namespace tessera
