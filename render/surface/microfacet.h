#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

enum class MicrofacetDistribution : std::uint8_t { beckmann, ggx };

/// Roughness is kept above this, as in Mitsuba: below it floats cannot hold the distribution.
inline constexpr float smallest_alpha = 1e-4f;

/// A distribution of microfacet normals with Smith's shadowing [Walter 2007, Heitz 2014]. Directions are unit and
/// in the shading frame; the roughness along its tangent is alpha * stretch, along its bitangent alpha / stretch,
/// and both are at least smallest_alpha.
struct Microfacets {
    MicrofacetDistribution distribution = MicrofacetDistribution::ggx;
    float alpha = 0.1f; ///< geometric mean of both
    float stretch = 1;  ///< 1: the same in all directions about the normal

    /// Of these roughnesses, or what is closest to them.
    static Microfacets anisotropic(MicrofacetDistribution distribution, float along_tangent,
                                   float along_bitangent);

    /// Density of facet normals, per solid angle: the integral of density * cos over the hemisphere is 1.
    float density(glm::vec3 normal) const;

    /// The share of the facets with this normal that `direction` sees unshadowed.
    float shadowing(glm::vec3 direction, glm::vec3 normal) const;

    /// A normal among those that `direction` (upper side) sees, with pdf_w = visible_pdf.
    glm::vec3 sample_visible(glm::vec3 direction, glm::vec2 u) const;

    /// Density of sample_visible, per solid angle of the normal.
    float visible_pdf(glm::vec3 direction, glm::vec3 normal) const;
};

} // namespace tessera
