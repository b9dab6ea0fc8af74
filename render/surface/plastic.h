#pragma once

#include "render/surface/microfacet.h"
#include "render/surface/scattering.h"

#include <array>
#include <optional>

namespace tessera {

/// How much light a dielectric boundary lets through, smooth or faceted, over the cosine on the outside. A table,
/// as facets have no formula for it; made once a material.
struct Coating {
    static constexpr int resolution = 64; ///< cosines from 0 to 1

    /// alpha = 0: a smooth boundary.
    Coating(float eta, MicrofacetDistribution distribution, float alpha);

    /// A smooth one under which light is scattered once: as `pplastic` of Mitsuba 3 has it, where neither what is
    /// sent back in counts nor that solid angles outside are larger.
    static Coating without_bounces(float eta);

    float transmittance(float cosine) const;

    float eta;                           ///< index inside over outside
    std::array<float, resolution> table; ///< share of light from outside that gets in
    float internal_reflectance;          ///< share of diffuse light from inside that is sent back
};

/// A diffuse base under a dielectric coating, as Mitsuba's `plastic` (alpha = 0) and `roughplastic` have it; the
/// upper side only. The coating reflects by itself; what gets in is scattered by the base, and gets out, or is
/// sent back in.
struct Plastic {
    const Coating* coating = nullptr;
    Microfacets facets{MicrofacetDistribution::beckmann, 0}; ///< alpha = 0: smooth
    Rgb specular_reflectance{1};
    Rgb base{0}; ///< what the base sends out of the light that has got in, after all its bounces inside
    float specular_weight = 0.5f; ///< share of samples for the coating where both reflect alike

    /// @param diffuse_reflectance of the base
    /// @param nonlinear           the colour deepens with each bounce inside
    Plastic(const Coating& coating, Microfacets facets, Rgb specular_reflectance, Rgb diffuse_reflectance,
            bool nonlinear);

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    /// The roughness of the base, through which paths can be connected; without one that of the coating.
    float roughness() const { return is_black(base) ? facets.alpha : 1; }
    Rgb albedo(glm::vec3 to_previous) const;

private:
    bool is_smooth() const { return facets.alpha <= 0; }
    float specular_probability(float cosine) const;
};

} // namespace tessera
