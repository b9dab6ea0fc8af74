#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"
#include "recon/solvers/poisson_weighted.h"

#include <cmath>

namespace tessera {

/// The weight of the primal in a weighted reconstruction, for a setting of alpha. It is less than alpha, as
/// weights already mistrust noisy gradients, and less by the fourth root of the edge of tiles that share their
/// noise.
inline float weighted_alpha(float alpha, float patch, const GuidedParameters& parameters = {}) {
    return parameters.alpha_scale * alpha / std::sqrt(std::sqrt(patch));
}

/// Returns weights of gradients from the variances V of `images`, for a primal of weight alpha^2 (weighted_alpha).
///
/// Image-space control variates [Rousselle 2016]: a pixel's neighbour plus the gradient between the two is one
/// more estimate of the pixel, whose weight is its inverse variance. alpha^2 bounds the trust in gradients, since
/// rare paths may not have been sampled yet:
///     w / alpha^2 = 1 / (alpha^2 + k V_gradient / V_primal),   k = edge_noise / sqrt(patch),
/// where V_primal is the smaller variance of the two pixels: a dark pixel beside a lamp's edge needs the gradient
/// least, and would take over the other's noise. A gradient has one weight for both of its pixels, so that the
/// reconstruction keeps the primal's mean.
///
/// Sample variances are noisy: each is replaced by the mean over the square around it, of variances relative to
/// the squared brightness (plus `dark` of the local mean). Without variances, as after one sample, they are
/// estimated from how much each value differs from its neighbours.
EdgeWeights weights_of_gradients(const GradientImages& images, float alpha,
                                 const GuidedParameters& parameters = {},
                                 const ParallelFor& parallel_for = serial_for);

/// The same for the gradients of a basis component, against the primal of the whole.
EdgeWeights weights_of_part(const GradientImages& images, const BasisComponent& part, float alpha,
                            const ParallelFor& parallel_for = serial_for);

} // namespace tessera
