#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"
#include "recon/poisson_weighted.h"

#include <cmath>

namespace tessera {

/// The weight of the primal, for a setting of alpha: half of it, as weights need not be wary of all gradients for
/// the sake of some. Where noise is alike in patches, its square is less by the square root of their edge.
inline float weighted_alpha(float alpha, float patch) {
    return 0.5f * alpha / std::sqrt(std::sqrt(patch));
}

/// Weights from the variances V of `images`, for a primal of weight alpha^2 (weighted_alpha). Where nothing is
/// noisy, they are 1. If it has no variances, as after a single sample, they are taken from how much each value
/// differs from its neighbours.
///
/// Image-space control variates [Rousselle 2016]: a pixel's neighbour, with the gradient between the two added, is
/// one more estimate of the pixel, which counts with the inverse of its variance. Against the primal this is
/// V_primal / V_gradient, but nobody should trust a gradient without limit, as rare paths that matter may not have
/// been seen yet: alpha^2 is the least ratio V_gradient / V_primal that is believed,
///     w / alpha^2 = 1 / (alpha^2 + k V_gradient / V_primal) ,
/// where V_primal is the smaller of those of both pixels, and k 1/2; less, over the square root of their edge,
/// where primals are alike in patches (GradientImages::patch), and tell less together than they would.
/// With one weight for both sides of a gradient, what one pixel gets from it is what the other loses: no light is
/// lost.
///
/// Sample variances are noisy, too, so they are blended with those around; primal variances more so, since nobody
/// should trust a gradient for the sake of a firefly beside it. What is blended are variances over the square of
/// the brightness, and of the primal those of pixels that look alike: a groove's pixels know how dark they are and
/// how sure that is, however noisy the bright boards on both sides. (Those that are taken from neighbours are
/// blended as they are, over squares: a single sample may be dark by chance.)
/// @param alike  of the images' size, by their guides, asked where variances are measured; null: primal variances
///               are blended over squares of 5x5 pixels
EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const AlikePixels* alike = nullptr,
                                 const ParallelFor& parallel_for = serial_for);

/// The same of the gradients of a part, against the primal of the whole; over squares.
EdgeWeights weights_of_part(const GradientImages& images, const CoefficientPart& part, float alpha,
                            const ParallelFor& parallel_for = serial_for);

} // namespace tessera
