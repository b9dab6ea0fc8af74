#pragma once

#include "recon/image.h"

namespace tessera {

/// What a gradient-domain method measures, as means over the samples taken; all images of one size.
/// A method without gradients leaves dx and dy empty.
struct GradientImages {
    RgbImage primal;      ///< radiance without what is in very_direct
    RgbImage dx;          ///< dx(x, y) estimates I(x+1, y) - I(x, y); the last column is 0 and means nothing
    RgbImage dy;          ///< dy(x, y) estimates I(x, y+1) - I(x, y); the last row is 0 and means nothing
    RgbImage very_direct; ///< emission seen by the camera itself; added after the reconstruction

    /// Variances of these means, summed over the channels; empty if they are unknown.
    Image<float> primal_variance{}, dx_variance{}, dy_variance{};

    /// Edge of the squares of pixels whose primals have much the same noise, as tiles that share their light make
    /// it; >= 1, where 1 means that every pixel has its own.
    float patch = 1;

    bool has_gradients() const { return !dx.empty() && !dy.empty(); }
    /// All three.
    bool has_variances() const { return !primal_variance.empty() && !dx_variance.empty() && !dy_variance.empty(); }
};

} // namespace tessera
