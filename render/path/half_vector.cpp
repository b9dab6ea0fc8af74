#include "render/path/half_vector.h"

namespace tessera {

std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset) {
    const bool transmits = base.to_previous.z * base_to_next.z < 0;
    const float base_index = transmits ? base.bsdf.relative_index(base.to_previous) : 1;
    const float offset_index = transmits ? offset.bsdf.relative_index(offset.to_previous) : 1;
    if (transmits && (base_index == 1 || offset_index == 1))
        return {};
    const glm::vec3 half = half_vector(base.to_previous, base_to_next, base_index);
    const auto to_next =
        transmits ? refract(offset.to_previous, half, offset_index) : reflect(offset.to_previous, half);
    // If it does not go to the same side as the base's, the way back would not find this half vector.
    if (!to_next || transmits != (to_next->z * offset.to_previous.z < 0))
        return {};
    const BsdfValue v = offset.bsdf.evaluate(offset.to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    const float jacobian = half_vector_jacobian(base.to_previous, base_to_next, half, base_index) /
                           half_vector_jacobian(offset.to_previous, *to_next, half, offset_index);
    if (!(jacobian > 0) || !std::isfinite(jacobian))
        return {};
    return CopiedScatter{*to_next, v.f_cos, v.pdf_w, jacobian};
}

std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset) {
    const DeltaValue v = offset.bsdf.evaluate_delta(offset.to_previous, scatter);
    if (!(v.probability > 0) || is_black(v.value))
        return {};
    return CopiedScatter{v.to_next, v.value, v.probability, 1};
}

} // namespace tessera
