#pragma once

#include "recon/image.h"

namespace tessera {

struct DielectricFresnel {
    float reflectance; ///< share of unpolarised light that is reflected; 1 at total internal reflection
    float cos_next;    ///< signed cosine of the refracted direction, on the other side; 0 at total reflection
    float eta;         ///< index on the far side over that on the near side
};

/// @param cos_previous signed cosine on the side from which light is looked at
/// @param eta index inside (below the surface) over outside
DielectricFresnel fresnel_dielectric(float cos_previous, float eta);

/// Share of unpolarised light that a conductor of complex index eta + i k reflects, per channel.
Rgb fresnel_conductor(float cos_previous, Rgb eta, Rgb k);

} // namespace tessera
