#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

enum class MicrofacetDistribution : std::uint8_t { beckmann, ggx };

/// Lower bound of alpha, as in Mitsuba; floats cannot represent narrower distributions.
inline constexpr float smallest_alpha = 1e-4f;

/// A distribution of microfacet normals with Smith shadowing [Walter 2007, Heitz 2014]. Directions are unit and
/// in the shading frame. The roughness is alpha * stretch along the tangent and alpha / stretch along the
/// bitangent; both are at least smallest_alpha.
struct Microfacets {
    MicrofacetDistribution distribution = MicrofacetDistribution::ggx;
    float alpha = 0.1f; ///< geometric mean of both roughnesses
    float stretch = 1;  ///< 1: isotropic

    /// Makes facets with these roughnesses, raised to smallest_alpha.
    static Microfacets anisotropic(MicrofacetDistribution distribution, float along_tangent,
                                   float along_bitangent);

    /// Returns D, the density of facet normals per solid angle; the integral of D cos over the hemisphere is 1.
    float density(glm::vec3 normal) const;

    /// Returns Smith's G1, the fraction of facets with this normal that are visible from `direction`.
    float shadowing(glm::vec3 direction, glm::vec3 normal) const;

    /// Samples a normal visible from `direction` (upper side), with pdf_w = visible_pdf.
    glm::vec3 sample_visible(glm::vec3 direction, glm::vec2 u) const;

    /// Returns the pdf of sample_visible, per solid angle of the normal.
    float visible_pdf(glm::vec3 direction, glm::vec3 normal) const;
};

} // namespace tessera
