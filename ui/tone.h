#pragma once

#include "recon/image.h"

namespace tessera {

/// How radiance becomes brightness on the screen.
struct Tone {
    enum class Curve {
        srgb,   ///< the display's own: what is linear looks linear
        gamma,  ///< value^(1/gamma)
        filmic, ///< highlights are compressed, then sRGB
    };
    Curve curve = Curve::srgb;
    float exposure = 0; ///< stops: radiance is multiplied by 2^exposure first
    float gamma = 2.2f; ///< of Curve::gamma

    bool operator==(const Tone&) const = default;
};

/// What the canvas shows for a radiance, in [0, 1]: the shader's curves for drawings beside it.
Rgb displayed(const Rgb& radiance, const Tone& tone);

} // namespace tessera
