#include "render/bsdf/rough_dielectric.h"

#include "render/bsdf/fresnel.h"

namespace tessera {

BsdfValue RoughDielectric::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z == 0 || to_next.z == 0)
        return {};
    const bool transmits = to_previous.z * to_next.z < 0;
    const float relative = relative_index(to_previous);
    const glm::vec3 half = half_vector(to_previous, to_next, transmits ? relative : 1);
    // Facets are seen alike from both sides, and from above by either direction.
    const glm::vec3 above = to_previous.z > 0 ? to_previous : -to_previous;
    const float masking = facets.shadowing(to_next, half);
    const float visible = facets.visible_pdf(above, half);
    if (!(masking > 0) || !(visible > 0))
        return {};
    const float reflected = fresnel_dielectric(glm::dot(to_previous, half), eta).reflectance;
    if (!transmits) {
        const float pdf_w = reflected * visible * half_vector_jacobian(to_previous, to_next, half, 1);
        return {specular_reflectance * (pdf_w * masking), pdf_w};
    }
    const float pdf_w = (1 - reflected) * visible * half_vector_jacobian(to_previous, to_next, half, relative);
    return {specular_transmittance * (pdf_w * masking / (relative * relative)), pdf_w};
}

std::optional<BsdfSample> RoughDielectric::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    if (to_previous.z == 0)
        return {};
    const glm::vec3 half = facets.sample_visible(to_previous.z > 0 ? to_previous : -to_previous, u);
    const bool reflects = lobe < fresnel_dielectric(glm::dot(to_previous, half), eta).reflectance;
    const auto to_next =
        reflects ? reflect(to_previous, half) : refract(to_previous, half, relative_index(to_previous));
    if (!to_next || reflects != (to_next->z * to_previous.z > 0))
        return {}; // the facet sends light to the side where its neighbours are in the way
    const BsdfValue v = evaluate(to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(*to_next, v.f_cos, v.pdf_w, false,
                                          reflects ? Scatter::reflect : Scatter::transmit);
}

} // namespace tessera
