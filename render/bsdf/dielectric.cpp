#include "render/bsdf/dielectric.h"

#include "render/bsdf/fresnel.h"

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

std::optional<BsdfSample> SmoothDielectric::sample(glm::vec3 to_previous, float lobe, glm::vec2) const {
    const float reflectance = fresnel_dielectric(to_previous.z, eta).reflectance;
    const Scatter scatter = lobe < reflectance ? Scatter::reflect : Scatter::transmit;
    const DeltaValue v = evaluate_delta(to_previous, scatter);
    if (v.probability <= 0 || is_black(v.value))
        return {};
    return BsdfSample{v.to_next, v.value, v.probability, true, scatter};
}

} // namespace tessera
