#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"
#include "recon/solvers/poisson_weighted.h"

#include <cmath>

namespace tessera {

/// Returns a of reconstruction (39), the weight of the primal in a weighted reconstruction, for a setting of
/// alpha. It is smaller than alpha, since the weights already reduce the trust in noisy gradients. It falls with
/// the fourth root of the edge of tiles, whose pixels share their noise.
inline float weighted_alpha(float alpha, float patch, const GuidedParameters& parameters = {}) {
    return parameters.alpha_scale * alpha / std::sqrt(std::sqrt(patch));
}

/// Returns the weights of gradients, reconstruction (38) and (39), from the variances V of `images`. alpha is
/// weighted_alpha().
///
/// In image-space control variates [Rousselle 2016], a neighbour plus the gradient between both pixels is one more
/// estimate of the pixel, weighted by its inverse variance. alpha^2 bounds the trust in gradients, since rare
/// paths may not have been sampled yet:
///     w / alpha^2 = 1 / (alpha^2 + k V_gradient / V_primal),   k = edge_noise / sqrt(patch) .
/// V_primal is the smaller variance of the two pixels: a dark pixel beside a lamp's edge needs the gradient least,
/// and would take over the other's noise. A gradient has one weight for both of its pixels, so that the
/// reconstruction keeps the primal's mean.
///
/// Sample variances are noisy, and are replaced by means over squares, relative to a squared brightness,
/// reconstruction (40). Without variances, as after one sample, they are estimated from the differences between
/// neighbours.
EdgeWeights weights_of_gradients(const GradientImages& images, float alpha,
                                 const GuidedParameters& parameters = {},
                                 const ParallelFor& parallel_for = serial_for);

/// Returns the same for the gradients of a basis component, against the variance of the primal of the whole.
EdgeWeights weights_of_component(const GradientImages& images, const BasisComponent& component, float alpha,
                                 const ParallelFor& parallel_for = serial_for);

} // namespace tessera
