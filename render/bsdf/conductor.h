#pragma once

#include "render/bsdf/microfacet.h"
#include "render/bsdf/scattering.h"

#include <optional>

namespace tessera {

/// Microfacets of a conductor; the upper side only.
struct RoughConductor {
    Microfacets facets;
    Rgb eta{0}; ///< complex index of refraction over the outside's: eta + i k
    Rgb k{1};
    Rgb specular_reflectance{1};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return facets.alpha; }
};

/// A perfectly smooth conductor, or with eta = 0 and k = 1 a perfect mirror; the upper side only.
struct SmoothConductor {
    Rgb eta{0};
    Rgb k{1};
    Rgb specular_reflectance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
};

} // namespace tessera
