#pragma once

#include "render/bsdf/scattering.h"

#include <optional>

namespace tessera {

/// A perfectly smooth boundary between two dielectrics. Radiance is divided by the square of the relative index
/// where it crosses, as it is squeezed into another solid angle.
struct SmoothDielectric {
    float eta = 1.5f; ///< index inside (below the surface) over outside
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
};

/// A thin pane of a dielectric, as one surface: light is reflected, or goes straight on; the bounces between the
/// two faces are summed.
struct ThinDielectric {
    float eta = 1.5f; ///< index of the pane over that around it
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
};

} // namespace tessera
