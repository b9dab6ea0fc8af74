#include "render/surface/principled.h"

#include "render/sampling/sampling.h"
#include "render/surface/material.h"
#include "render/surface/microfacet.h"
#include "render/surface/principled_lobes.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace tessera {

namespace {

using namespace principled;

/// Microfacets of the clear coat: the long-tailed GTR distribution with exponent 1 [Burley 2012, B.2].
struct ClearCoat {
    float alpha2;

    explicit ClearCoat(float gloss) {
        const float alpha = 0.1f + gloss * (0.001f - 0.1f);
        alpha2 = alpha * alpha;
    }
    /// Returns the density of facet normals per solid angle.
    float density(float cosine) const {
        return (alpha2 - 1) / (pi * std::log(alpha2) * (1 + (alpha2 - 1) * cosine * cosine));
    }
    /// Samples a normal with pdf_w = density() * cosine.
    glm::vec3 sample(glm::vec2 u) const {
        const float cos2 = std::clamp((1 - std::pow(alpha2, 1 - u.y)) / (1 - alpha2), 0.0f, 1.0f);
        const float sine = std::sqrt(1 - cos2), phi = 2 * pi * u.x;
        return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(cos2)};
    }
};

/// The parameters of a Principled at its point.
struct Base {
    Rgb color;
    Microfacets facets;
    float metallic;
    float diffuse;      ///< diffuse fraction of the base
    float transmission; ///< glass fraction of the base
    float coat;         ///< weight of the clear coat

    explicit Base(const Principled& p)
        : color(p.material->base_color.filtered(p.at)),
          facets(facets_of(p.material->roughness.scalar(p.at), p.material->anisotropic.scalar(p.at))),
          metallic(p.material->metallic.scalar(p.at)) {
        const float spec_trans = p.material->spec_trans.scalar(p.at);
        diffuse = (1 - metallic) * (1 - spec_trans);
        transmission = (1 - metallic) * spec_trans;
        coat = 0.25f * p.material->clearcoat.scalar(p.at);
    }

    /// Returns the sum of the sampling weights from above: of diffuse base, coat and facets (1).
    float total_weight() const { return diffuse + coat + 1; }
    /// Returns the probability of refraction when a facet is sampled.
    float refracted(bool above, float fresnel) const { return (above ? transmission : 1) * (1 - fresnel); }
};

/// Returns the Fresnel term of facets seen from above: a blend of metal, dielectric and tinted dielectric.
Rgb fresnel_of(const Principled& p, const Base& base, float dielectric, float cos_half) {
    const PrincipledMaterial& m = *p.material;
    const float tint_weight = m.spec_tint.scalar(p.at);
    Rgb sum((1 - base.metallic) * (1 - tint_weight) * dielectric);
    if (base.metallic > 0)
        sum += base.metallic * schlick(base.color, cos_half, m.eta);
    if (tint_weight > 0)
        sum += (1 - base.metallic) * tint_weight *
               schlick(tint(base.color) * reflectance_at_normal(m.eta), cos_half, m.eta);
    return sum;
}

/// Evaluates diffuse base, sheen and clear coat for two upper directions; the pdf lacks the factor 1 /
/// total_weight().
BsdfValue evaluate_upper(const Principled& p, const Base& base, glm::vec3 to_previous, glm::vec3 to_next,
                         glm::vec3 half) {
    const PrincipledMaterial& m = *p.material;
    const Cosines c{to_previous.z, to_next.z, glm::dot(to_next, half)};
    BsdfValue v;
    if (base.diffuse > 0) {
        v.pdf_w = base.diffuse * c.next * inv_pi;
        v.f_cos = base.color * (v.pdf_w * diffuse_shape(m, p.at, c)) +
                  sheen_of(m, p.at, base.color, c) * ((1 - base.metallic) * c.next);
    }
    if (base.coat > 0) {
        const float density = ClearCoat(m.clearcoat_gloss.scalar(p.at)).density(half.z);
        const Microfacets shadows{MicrofacetDistribution::ggx, 0.25f};
        const float seen = shadows.shadowing(to_previous, half) * shadows.shadowing(to_next, half);
        v.f_cos += Rgb(base.coat * schlick(0.04f, c.half, m.eta) * density * seen * c.next);
        v.pdf_w += base.coat * density * half.z / (4 * c.half);
    }
    return v;
}

} // namespace

BsdfValue Principled::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    const Base base(*this);
    const bool above = to_previous.z > 0, transmits = to_previous.z * to_next.z < 0;
    if (to_previous.z == 0 || to_next.z == 0 || ((!above || transmits) && base.transmission <= 0))
        return {};
    const float relative = above ? material->eta : 1 / material->eta;
    const glm::vec3 half = half_vector(to_previous, to_next, transmits ? relative : 1);
    const BsdfValue upper =
        above && !transmits ? evaluate_upper(*this, base, to_previous, to_next, half) : BsdfValue{};

    // Facets, as in RoughDielectric::evaluate().
    const float masking = base.facets.shadowing(to_next, half);
    const float visible = base.facets.visible_pdf(above ? to_previous : -to_previous, half);
    const float cos_half = glm::dot(to_previous, half);
    const float fresnel = fresnel_dielectric(cos_half, material->eta).reflectance;
    const float refracted = base.refracted(above, fresnel);
    const float facets = visible * half_vector_jacobian(to_previous, to_next, half, transmits ? relative : 1);
    const float total_weight = above ? base.total_weight() : 1;
    BsdfValue v = upper;
    if (masking > 0 && visible > 0) {
        v.pdf_w += (transmits ? refracted : 1 - refracted) * facets;
        if (transmits)
            v.f_cos = glm::sqrt(base.color) *
                      (base.transmission * (1 - fresnel) * facets * masking / (relative * relative));
        else if (fresnel > 0) // as in Mitsuba 3, facets reflect nothing where the indices are equal
            v.f_cos += facets * masking *
                       (above ? fresnel_of(*this, base, fresnel, cos_half) : Rgb(base.transmission * fresnel));
    }
    v.pdf_w /= total_weight;
    return v;
}

std::optional<BsdfSample> Principled::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    const Base base(*this);
    const bool above = to_previous.z > 0;
    if (to_previous.z == 0 || (!above && base.transmission <= 0))
        return {};
    float rest = above ? lobe * base.total_weight() : base.diffuse + base.coat + lobe;
    std::optional<glm::vec3> to_next;
    bool transmits = false;
    if (rest < base.diffuse) {
        to_next = sample_cosine_hemisphere(u);
    } else if ((rest -= base.diffuse) < base.coat) {
        to_next = reflect(to_previous, ClearCoat(material->clearcoat_gloss.scalar(at)).sample(u));
    } else {
        rest -= base.coat;
        const glm::vec3 half = base.facets.sample_visible(above ? to_previous : -to_previous, u);
        const float fresnel = fresnel_dielectric(glm::dot(to_previous, half), material->eta).reflectance;
        transmits = rest < base.refracted(above, fresnel);
        to_next = transmits ? refract(to_previous, half, relative_index(to_previous)) : reflect(to_previous, half);
    }
    if (!to_next || transmits != (to_next->z * to_previous.z < 0))
        return {}; // other facets block this direction
    const BsdfValue v = evaluate(to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(*to_next, v.f_cos, v.pdf_w, false,
                                          transmits ? Scatter::transmit : Scatter::reflect);
}

float Principled::roughness() const {
    const Base base(*this);
    if (base.diffuse > 0 && !(is_black(base.color) && material->sheen.scalar(at) <= 0))
        return 1;
    return base.facets.alpha;
}

/// Treats all facets as flat and omits sheen and clear coat.
Rgb Principled::albedo(glm::vec3 to_previous) const {
    const Base base(*this);
    const float fresnel = fresnel_dielectric(to_previous.z, material->eta).reflectance;
    return fresnel_of(*this, base, fresnel, std::abs(to_previous.z)) + base.diffuse * base.color +
           base.transmission * (1 - fresnel) * glm::sqrt(base.color);
}

float Principled::relative_index(glm::vec3 to_previous) const {
    if (material->spec_trans.scalar(at) <= 0 || material->metallic.scalar(at) >= 1)
        return 1;
    return to_previous.z > 0 ? material->eta : 1 / material->eta;
}

} // namespace tessera
