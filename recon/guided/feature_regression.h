#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/parallel.h"

#include <cstddef>
#include <span>

namespace tessera {

// A pixel at an edge shows parts of both sides, and no pixel nearby has similar features: kernels leave it its
// noise. But radiance and the means of albedo, normal, depth and roughness are about linear in these parts. So, in
// squares of 5x5 pixels, radiance is a first-order function of the features g [Bitterli 2016: Nonlinearly Weighted
// First-order Regression for Denoising Monte Carlo Renderings],
//     minimise over a, s   sum over q of w_q (x_q - a - s . (g_q - g_p))^2 ,
// and pixel p becomes a. A ridge draws the slopes s to 0, so that there is always a solution. The result is linear
// in the values x: the same weights give what is left of their noise.

inline constexpr std::size_t most_regressed = 6; ///< planes at a time

/// Writes a of all pixels, for each plane of values. Where features are not finite, or too large to be squared,
/// pixels stay what they are.
/// @param weights  w of each pixel, > 0 and at most 1; those of a square no further apart than 1e14
/// @param ridge    weight of the squared slopes, relative to the sum of the weights of a square
/// @param fitted   as many as values, of the picture's size, any content
void write_regressions(std::span<const Plane> values, const FeaturePlanes& features, const Plane& weights,
                       float ridge, const ParallelFor& parallel_for, std::span<Plane> fitted);

} // namespace tessera
