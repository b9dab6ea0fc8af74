#pragma once

#include "recon/gradient_images.h"
#include "recon/parallel.h"

namespace tessera {

/// How far gradients are to be trusted, in [0, 1]: x(x, y) is that of dx(x, y), y(x, y) that of dy(x, y). The last
/// column of x and the last row of y are 0, as nothing is measured there.
struct EdgeWeights {
    Image<float> x, y;
};

/// Weights from the variances of `images`, which has them. Where nothing is noisy, they are 1.
///
/// Image-space control variates [Rousselle 2016]: a pixel's neighbour, with the gradient between the two added, is
/// one more estimate of the pixel. If reuse has brought the variance of the pixels down to V_primal / c, the best
/// share of that estimate falls with the variance of the gradient as 1 / (1 + c V / V_primal). With one weight for
/// both sides of a gradient, what one pixel gets from it is what the other loses: no light is lost.
///
/// Sample variances are noisy, and too low where the rare paths that matter have not been seen yet, so they are
/// blended with those around; primal variances more so, since nobody should trust a gradient for the sake of a
/// firefly beside it.
EdgeWeights weights_of_gradients(const GradientImages& images, const ParallelFor& parallel_for = serial_for);

} // namespace tessera
