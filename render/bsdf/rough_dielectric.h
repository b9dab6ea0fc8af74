#pragma once

#include "render/bsdf/microfacet.h"
#include "render/bsdf/scattering.h"

#include <optional>

namespace tessera {

/// Microfacets of a boundary between two dielectrics [Walter 2007]. Radiance is divided by the square of the
/// relative index where it crosses, as by SmoothDielectric.
struct RoughDielectric {
    Microfacets facets;
    float eta =
        1.5f; ///< index inside (below the surface) over outside; not 1: facets that do not bend hide nothing
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return facets.alpha; }
    float relative_index(glm::vec3 to_previous) const { return to_previous.z > 0 ? eta : 1 / eta; }
};

} // namespace tessera
