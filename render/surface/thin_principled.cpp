#include "render/sampling/sampling.h"
#include "render/surface/material.h"
#include "render/surface/microfacet.h"
#include "render/surface/principled.h"
#include "render/surface/principled_lobes.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

using namespace principled;

/// The parameters of a ThinPrincipled at its point, and the sampling probabilities of its lobes.
struct Sheet {
    Rgb color;
    float eta;
    float specular;     ///< fraction of the specular lobes; half of their samples reflect
    float transmission; ///< transmitted fraction of diffuse light
    float roughness, anisotropic;

    explicit Sheet(const ThinPrincipled& p)
        : color(p.material->base_color.filtered(p.at)), eta(p.material->eta.scalar(p.at)),
          specular(p.material->spec_trans.scalar(p.at)), transmission(0.5f * p.material->diff_trans.scalar(p.at)),
          roughness(p.material->roughness.scalar(p.at)), anisotropic(p.material->anisotropic.scalar(p.at)) {}

    Microfacets reflecting() const { return facets_of(roughness, anisotropic); }
    /// Two refractions blur less than one: the second partly reverses the first [Burley 2015, fig. 15].
    Microfacets transmitting() const { return facets_of((0.65f * eta - 0.35f) * roughness, anisotropic); }
    float diffuse(bool transmits) const { return (1 - specular) * (transmits ? transmission : 1 - transmission); }
};

} // namespace

BsdfValue ThinPrincipled::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z < 0) { // the BSDF is symmetric
        to_previous = -to_previous;
        to_next = -to_next;
    }
    if (to_previous.z == 0 || to_next.z == 0)
        return {};
    const Sheet sheet(*this);
    const bool transmits = to_next.z < 0;
    const float cos_next = std::abs(to_next.z);
    const glm::vec3 half = half_vector(to_previous, transmits ? across(to_next) : to_next);
    const float cos_half = glm::dot(to_previous, half);

    BsdfValue v;
    v.pdf_w = sheet.diffuse(transmits) * cos_next * inv_pi;
    v.f_cos = sheet.color * v.pdf_w;
    if (!transmits && v.pdf_w > 0) {
        const Cosines c{to_previous.z, cos_next, cos_half};
        v.f_cos = v.f_cos * diffuse_shape(*material, at, c) +
                  sheen_of(*material, at, sheet.color, c) * (sheet.diffuse(false) * cos_next);
    }
    if (sheet.specular <= 0)
        return v;
    // Transmission is the mirror image of a reflection.
    const Microfacets facets = transmits ? sheet.transmitting() : sheet.reflecting();
    const float pdf_w = sheet.specular * facets.visible_pdf(to_previous, half) / (4 * cos_half);
    const float masking = facets.shadowing(to_next, half);
    if (!(pdf_w > 0) || !(masking > 0))
        return v;
    const float dielectric = fresnel_dielectric(cos_half, sheet.eta).reflectance;
    Rgb factor = sheet.color * (1 - dielectric);
    if (!transmits) {
        const float tint_weight = material->spec_tint.scalar(at);
        factor = Rgb((1 - tint_weight) * dielectric);
        if (tint_weight > 0)
            factor +=
                tint_weight * schlick(tint(sheet.color) * reflectance_at_normal(sheet.eta), cos_half, sheet.eta);
    }
    v.f_cos += factor * (pdf_w * masking);
    v.pdf_w += 0.5f * pdf_w;
    return v;
}

std::optional<BsdfSample> ThinPrincipled::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    const Sheet sheet(*this);
    const glm::vec3 above = to_previous.z < 0 ? -to_previous : to_previous;
    glm::vec3 to_next; // as if reflected from above
    bool transmits;
    if (lobe < sheet.specular) {
        transmits = lobe < 0.5f * sheet.specular;
        const Microfacets facets = transmits ? sheet.transmitting() : sheet.reflecting();
        const glm::vec3 half = facets.sample_visible(above, u);
        to_next = reflect(above, half);
        if (transmits && !(facets.shadowing(across(to_next), half) > 0))
            return {}; // as in Mitsuba 3, the facet's back is not visible from there
    } else {
        transmits = lobe < sheet.specular + sheet.diffuse(true);
        to_next = sample_cosine_hemisphere(u);
    }
    if (to_next.z <= 0)
        return {}; // other facets block this direction
    if (transmits)
        to_next = across(to_next);
    if (to_previous.z < 0)
        to_next = -to_next;
    const BsdfValue v = evaluate(to_previous, to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false,
                                          transmits ? Scatter::transmit : Scatter::reflect);
}

float ThinPrincipled::roughness() const {
    const Sheet sheet(*this);
    if (sheet.specular < 1 && !(is_black(sheet.color) && material->sheen.scalar(at) <= 0))
        return 1;
    return std::max(sheet.reflecting().alpha, sheet.transmitting().alpha);
}

Rgb ThinPrincipled::albedo(glm::vec3 to_previous) const {
    const Sheet sheet(*this);
    const float fresnel = fresnel_dielectric(std::abs(to_previous.z), sheet.eta).reflectance;
    return sheet.color * (1 - sheet.specular * fresnel) + sheet.specular * fresnel;
}

} // namespace tessera
