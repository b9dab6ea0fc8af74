#pragma once

#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

#include <array>

namespace tessera {

// A pixel at an edge looks like none of those around it: it shows some of both sides, in shares of its own, and so
// a kernel of pixels that look alike leaves it its noise. But radiance and the means of albedo, normal, nearness
// and roughness over the pixel are linear in these shares alike. So, in squares of 5x5 pixels, radiance is a
// first-order function of the guides [Bitterli and others 2016: Nonlinearly Weighted First-order Regression for
// Denoising Monte Carlo Renderings],
//     least over a, b of  sum over q of w_q (x_q - a - b . (g_q - g_p))^2 + lambda W |b|^2 ,   W = sum of w_q ,
// and pixel p becomes a. That is linear in the pixels' values x: what the same does to their noise is the noise of
// a.

/// Planes that take part: three channels of a picture and three of its noise.
using RegressedPlanes = std::array<Plane, 6>;

/// Writes a of all pixels.
/// @param weights  w of each pixel, > 0; one over the square of its brightness, so that all errors are relative
/// @param fitted   of the picture's size, anything
void write_regressions(const RegressedPlanes& values, const GuidePlanes& guides, const Plane& weights,
                       const ParallelFor& parallel_for, RegressedPlanes& fitted);

} // namespace tessera
