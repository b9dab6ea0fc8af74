#pragma once

#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

#include <cstddef>
#include <span>

namespace tessera {

// A pixel at an edge looks like none of those around it: it shows some of both sides, in shares of its own, and so
// a kernel of pixels that look alike leaves it its noise. But radiance and the means of albedo, normal, nearness
// and roughness over the pixel are linear in these shares alike. So, in squares of 5x5 pixels, radiance is a
// first-order function of the guides [Bitterli and others 2016: Nonlinearly Weighted First-order Regression for
// Denoising Monte Carlo Renderings],
//     least over a, s of  sum over q of w_q (x_q - a - s . (g_q - g_p))^2 ,
// and pixel p becomes a. Slopes s are drawn to 0 by a little, so that there is always an answer, and p counts a
// thousandth of all the weights more. That is linear in the pixels' values x: what the same does to their noise is
// the noise of a.

inline constexpr std::size_t most_regressed = 6; ///< planes at a time

/// Writes a of all pixels, for each plane of values. Where guides are beyond what floats can square, or no
/// numbers, pixels stay what they are.
/// @param weights  w of each pixel, > 0 and at most 1; those of a square no further apart than 1e14
/// @param fitted   as many as values, of the picture's size, anything
void write_regressions(std::span<const Plane> values, const GuidePlanes& guides, const Plane& weights,
                       const ParallelFor& parallel_for, std::span<Plane> fitted);

} // namespace tessera
