#include "render/bsdf/dielectric.h"

#include "render/bsdf/fresnel.h"

#include <cmath>

namespace tessera {

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

/// Chooses between the two delta parts, of which reflection has the probability `reflectance`.
template <class B>
std::optional<BsdfSample> sample_delta(const B& bsdf, glm::vec3 to_previous, float lobe, float reflectance) {
    const Scatter scatter = lobe < reflectance ? Scatter::reflect : Scatter::transmit;
    const DeltaValue v = bsdf.evaluate_delta(to_previous, scatter);
    if (v.probability <= 0 || is_black(v.value))
        return {};
    return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, scatter);
}

/// Share that a thin pane reflects: R + T R T + T R R R T + ... = 2 R / (1 + R).
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

} // namespace tessera
