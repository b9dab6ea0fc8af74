#pragma once

#include "render/surface/microfacet.h"
#include "render/surface/scattering.h"

#include <optional>

namespace tessera {

/// Microfacet reflection by a conductor, on the upper side only.
struct RoughConductor {
    Microfacets facets;
    Rgb eta{0}; ///< complex index of refraction relative to the outside: eta + i k
    Rgb k{1};
    Rgb specular_reflectance{1};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return facets.alpha; }
    Rgb albedo(glm::vec3 to_previous) const {
        return specular_reflectance * fresnel_conductor(to_previous.z, eta, k);
    }
};

/// A perfectly smooth conductor, on the upper side only; a perfect mirror for eta = 0 and k = 1.
struct SmoothConductor {
    Rgb eta{0};
    Rgb k{1};
    Rgb specular_reflectance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
    Rgb albedo(glm::vec3) const { return Rgb(1); }
};

/// A perfectly smooth boundary between two dielectrics. Transmitted radiance is divided by the square of the
/// relative index, because refraction changes its solid angle.
struct SmoothDielectric {
    float eta = 1.5f; ///< index of refraction inside (below the surface) over outside
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
    Rgb albedo(glm::vec3) const { return Rgb(1); }
    float relative_index(glm::vec3 to_previous) const { return to_previous.z > 0 ? eta : 1 / eta; }
};

/// A thin dielectric pane as one surface, which reflects light or transmits it unbent. The bounces between its
/// two faces are summed.
struct ThinDielectric {
    float eta = 1.5f; ///< index of refraction of the pane over that around it
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3, glm::vec3) const { return {}; }
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    float roughness() const { return 0; }
    Rgb albedo(glm::vec3) const { return Rgb(1); }
};

/// A microfacet boundary between two dielectrics [Walter 2007]. Transmitted radiance is divided by the square of
/// the relative index, as by SmoothDielectric.
struct RoughDielectric {
    Microfacets facets;
    float eta = 1.5f; ///< index of refraction inside (below) over outside; not 1
    Rgb specular_reflectance{1};
    Rgb specular_transmittance{1};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return facets.alpha; }
    Rgb albedo(glm::vec3) const { return Rgb(1); }
    float relative_index(glm::vec3 to_previous) const { return to_previous.z > 0 ? eta : 1 / eta; }
};

} // namespace tessera
