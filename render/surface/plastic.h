#pragma once

#include "render/surface/microfacet.h"
#include "render/surface/scattering.h"

#include <array>
#include <optional>

namespace tessera {

/// The transmittance of a smooth or rough dielectric boundary as a function of the outer cosine. Tabulated once
/// per material, because rough boundaries have no closed form.
struct Coating {
    static constexpr int resolution = 64; ///< number of cosines from 0 to 1

    /// alpha = 0: a smooth boundary.
    Coating(float eta, MicrofacetDistribution distribution, float alpha);

    /// Makes a smooth coating for Mitsuba 3's `pplastic`, which ignores internal reflection and the change of
    /// solid angle by refraction.
    static Coating without_bounces(float eta);

    /// Returns the transmittance for a cosine on the outside.
    float transmittance(float cosine) const;

    float eta;                           ///< index of refraction inside over outside
    std::array<float, resolution> table; ///< transmittance from outside
    float internal_reflectance;          ///< reflectance of the boundary for diffuse light from inside
};

/// A diffuse base under a dielectric coating, as Mitsuba's `plastic` (alpha = 0) and `roughplastic`, on the upper
/// side only. The coating reflects specularly; transmitted light bounces between base and coating until it
/// leaves.
struct Plastic {
    const Coating* coating = nullptr;
    Microfacets facets{MicrofacetDistribution::beckmann, 0}; ///< alpha = 0: smooth
    Rgb specular_reflectance{1};
    Rgb base{0}; ///< pi f of the base after all internal bounces, without the transmittances of the coating
    float specular_weight = 0.5f; ///< weight of the coating in sampling, from the two reflectances

    /// @param diffuse_reflectance of the base
    /// @param nonlinear           the colour saturates with each internal bounce
    Plastic(const Coating& coating, Microfacets facets, Rgb specular_reflectance, Rgb diffuse_reflectance,
            bool nonlinear);

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3 to_previous, Scatter scatter) const;
    /// Returns 1, the roughness of the diffuse base; without a base the roughness of the coating.
    float roughness() const { return is_black(base) ? facets.alpha : 1; }
    Rgb albedo(glm::vec3 to_previous) const;

private:
    bool is_smooth() const { return facets.alpha <= 0; }
    float specular_probability(float cosine) const;
};

} // namespace tessera
