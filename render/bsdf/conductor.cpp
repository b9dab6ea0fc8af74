#include "render/bsdf/conductor.h"

#include "render/bsdf/fresnel.h"

namespace tessera {

BsdfValue RoughConductor::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    // f cos = F D G1 G1 / (4 cos_previous) [Walter 2007, eq. 20]; sampling visible normals has all but the
    // Fresnel term and the shadowing of to_next in its density.
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

} // namespace tessera
