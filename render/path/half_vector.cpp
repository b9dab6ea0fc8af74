#include "render/path/half_vector.h"

namespace tessera {

namespace {

/// A direction of the base's frame in the offset's, turned along with the normal by the shortest arc: frames
/// themselves may lie about normals in any way, and half vectors of neighbours would then point anywhere. The same
/// way back; the angle to the normal is kept.
glm::vec3 carry(const Frame& base, const Frame& offset, glm::vec3 local) {
    const float cosine = glm::dot(base.normal, offset.normal);
    if (cosine < -0.99f)
        return local; // no arc is the shortest
    const glm::vec3 world = base.to_world(local);
    const glm::vec3 axis = glm::cross(base.normal, offset.normal);
    const glm::vec3 turned =
        cosine * world + glm::cross(axis, world) + axis * (glm::dot(axis, world) / (1 + cosine)); // [Rodrigues]
    glm::vec3 result = offset.to_local(turned);
    result.z = local.z;
    return glm::normalize(result);
}

} // namespace

std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset) {
    const bool transmits = base.to_previous.z * base_to_next.z < 0;
    const float base_index = transmits ? base.bsdf.relative_index(base.to_previous) : 1;
    const float offset_index = transmits ? offset.bsdf.relative_index(offset.to_previous) : 1;
    if (transmits && (base_index == 1 || offset_index == 1))
        return {};
    const glm::vec3 half = half_vector(base.to_previous, base_to_next, base_index);
    const glm::vec3 copied = carry(base.frame, offset.frame, half);
    const auto to_next =
        transmits ? refract(offset.to_previous, copied, offset_index) : reflect(offset.to_previous, copied);
    // If it does not go to the same side as the base's, the way back would not find this half vector.
    if (!to_next || transmits != (to_next->z * offset.to_previous.z < 0))
        return {};
    const BsdfValue v = offset.bsdf.evaluate(offset.to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    const float jacobian = half_vector_jacobian(base.to_previous, base_to_next, half, base_index) /
                           half_vector_jacobian(offset.to_previous, *to_next, copied, offset_index);
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
