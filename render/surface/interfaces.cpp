#include "render/surface/interfaces.h"

#include "render/surface/scattering.h"

#include <cmath>

namespace tessera {

BsdfValue RoughConductor::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    // f cos = F D G1 G1 / (4 cos_previous) [Walter 2007, eq. 20]. The pdf of sampling visible normals has all
    // factors except F and the shadowing of to_next.
    const glm::vec3 half = half_vector(to_previous, to_next);
    const float cos_half = glm::dot(to_previous, half);
    const float pdf_w = facets.density(half) * facets.shadowing(to_previous, half) / (4 * to_previous.z);
    if (!(pdf_w > 0))
        return {};
    const Rgb f = specular_reflectance * fresnel_conductor(cos_half, eta, k);
    return {f * (pdf_w * facets.shadowing(to_next, half)), pdf_w};
}

std::optional<BsdfSample> RoughConductor::sample(glm::vec3 to_previous, float, glm::vec2 u) const {
    if (to_previous.z <= 0)
        return {};
    const glm::vec3 to_next = reflect(to_previous, facets.sample_visible(to_previous, u));
    const BsdfValue v = evaluate(to_previous, to_next);
    if (v.pdf_w <= 0 || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
}

DeltaValue SmoothConductor::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    if (to_previous.z <= 0 || scatter != Scatter::reflect)
        return {};
    return {reflect(to_previous), specular_reflectance * fresnel_conductor(to_previous.z, eta, k), 1};
}

std::optional<BsdfSample> SmoothConductor::sample(glm::vec3 to_previous, float, glm::vec2) const {
    const DeltaValue v = evaluate_delta(to_previous, Scatter::reflect);
    if (is_black(v.value))
        return {};
    return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, Scatter::reflect);
}

DeltaValue SmoothDielectric::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    const DielectricFresnel fresnel = fresnel_dielectric(to_previous.z, eta);
    if (scatter == Scatter::reflect)
        return {reflect(to_previous), specular_reflectance * fresnel.reflectance, fresnel.reflectance};
    if (fresnel.cos_next == 0)
        return {}; // total internal reflection
    const float near_over_far = 1 / fresnel.eta;
    const float share = 1 - fresnel.reflectance;
    const glm::vec3 to_next(-near_over_far * to_previous.x, -near_over_far * to_previous.y, fresnel.cos_next);
    return {to_next, specular_transmittance * (share * near_over_far * near_over_far), share};
}

namespace {

/// Samples one of the two delta parts; reflection has the probability `reflectance`.
template <class B>
std::optional<BsdfSample> sample_delta(const B& bsdf, glm::vec3 to_previous, float lobe, float reflectance) {
    const Scatter scatter = lobe < reflectance ? Scatter::reflect : Scatter::transmit;
    const DeltaValue v = bsdf.evaluate_delta(to_previous, scatter);
    if (v.probability <= 0 || is_black(v.value))
        return {};
    return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, scatter);
}

/// Returns the reflectance of a thin pane: R + T R T + T R R R T + ... = 2 R / (1 + R) with T = 1 - R.
float pane_reflectance(float cosine, float eta) {
    const float r = fresnel_dielectric(std::abs(cosine), eta).reflectance;
    return 2 * r / (1 + r);
}

} // namespace

std::optional<BsdfSample> SmoothDielectric::sample(glm::vec3 to_previous, float lobe, glm::vec2) const {
    return sample_delta(*this, to_previous, lobe, fresnel_dielectric(to_previous.z, eta).reflectance);
}

DeltaValue ThinDielectric::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    const float reflectance = pane_reflectance(to_previous.z, eta);
    if (scatter == Scatter::reflect)
        return {reflect(to_previous), specular_reflectance * reflectance, reflectance};
    return {-to_previous, specular_transmittance * (1 - reflectance), 1 - reflectance};
}

std::optional<BsdfSample> ThinDielectric::sample(glm::vec3 to_previous, float lobe, glm::vec2) const {
    return sample_delta(*this, to_previous, lobe, pane_reflectance(to_previous.z, eta));
}

BsdfValue RoughDielectric::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z == 0 || to_next.z == 0)
        return {};
    const bool transmits = to_previous.z * to_next.z < 0;
    const float relative = relative_index(to_previous);
    const glm::vec3 half = half_vector(to_previous, to_next, transmits ? relative : 1);
    // The facets are symmetric, so the upper of the two viewing directions stands for either.
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
        return {}; // other facets block this direction
    const BsdfValue v = evaluate(to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(*to_next, v.f_cos, v.pdf_w, false,
                                          reflects ? Scatter::reflect : Scatter::transmit);
}

} // namespace tessera
