#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

namespace tessera {

/// How far gradients are to be trusted, in [0, 1]: x(x, y) is that of dx(x, y), y(x, y) that of dy(x, y). The last
/// column of x and the last row of y are 0, as nothing is measured there.
struct EdgeWeights {
    Image<float> x, y;
};

/// Weights from the variances V of `images`, for a primal of weight alpha^2. Where nothing is noisy, they are 1.
/// If it has no variances, as after a single sample, they are taken from how much each value differs from its
/// neighbours.
///
/// Image-space control variates [Rousselle 2016]: a pixel's neighbour, with the gradient between the two added, is
/// one more estimate of the pixel, which counts with the inverse of its variance. Against the primal this is
/// V_primal / V_gradient, but nobody should trust a gradient without limit, as rare paths that matter may not have
/// been seen yet: alpha^2 is the least ratio V_gradient / V_primal that is believed,
///     w / alpha^2 = 1 / (alpha^2 + k V_gradient / V_primal) ,
/// where V_primal is the geometric mean of those of both pixels.
/// With one weight for both sides of a gradient, what one pixel gets from it is what the other loses: no light is
/// lost.
///
/// Sample variances are noisy, too, so they are blended with those around; primal variances more so, since nobody
/// should trust a gradient for the sake of a firefly beside it.
EdgeWeights weights_of_gradients(const GradientImages& images, float alpha,
                                 const ParallelFor& parallel_for = serial_for);

} // namespace tessera
