#pragma once

#include "render/bsdf/scattering.h"

#include <optional>

namespace tessera {

/// The modified Phong model [Lafortune 1994], a diffuse part and a lobe about the mirror direction; the upper side
/// only.
struct Phong {
    float exponent = 30;
    Rgb diffuse_reflectance{0};
    Rgb specular_reflectance{0};
    float specular_weight = 0; ///< share of samples for the lobe

    /// Reflectances that are above 1 together are scaled down to it.
    Phong(float exponent, Rgb diffuse_reflectance, Rgb specular_reflectance);

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const;
};

} // namespace tessera
