#include "render/paths/shift.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// Rotates v by the shortest arc between two unit vectors, which must not be opposite (Rodrigues' formula).
glm::vec3 turn(glm::vec3 from, glm::vec3 to, glm::vec3 v) {
    const glm::vec3 sum = from + to; // accurate for nearly opposite vectors, too
    const float one_and_cosine = 0.5f * glm::dot(sum, sum);
    const glm::vec3 axis = glm::cross(from, to);
    return (one_and_cosine - 1) * v + glm::cross(axis, v) + axis * (glm::dot(axis, v) / one_and_cosine);
}

/// Pole of the rotation that aligns normals. Any fixed direction works.
constexpr glm::vec3 pole(0.36f, 0.48f, 0.8f);

/// Returns whether a normal is nearly opposite to the pole. It is then rotated to -pole, and by a half turn.
bool is_far_side(glm::vec3 normal) {
    return glm::dot(normal, pole) < -0.999f;
}
glm::vec3 half_turn(glm::vec3 v) {
    constexpr glm::vec3 across(0.8f, -0.6f, 0);
    return 2 * glm::dot(across, v) * across - v;
}
glm::vec3 to_pole(glm::vec3 normal, glm::vec3 v) {
    return is_far_side(normal) ? half_turn(turn(normal, -pole, v)) : turn(normal, pole, v);
}
glm::vec3 from_pole(glm::vec3 normal, glm::vec3 v) {
    return is_far_side(normal) ? turn(-pole, normal, half_turn(v)) : turn(pole, normal, v);
}

/// Rotates a direction from the base's frame to the offset's, with the rotation that turns the base's normal to
/// the pole and then to the offset's normal. The tangents of the frames are arbitrary, so local coordinates alone
/// would not correspond. The shift must be transitive over T. Shortest arcs from normal to normal are not: around
/// three normals they add up to a rotation. The rotation keeps the angle to the normal. Far from the pole, it
/// twists the half vectors of adjacent normals more, which is noise and no bias.
glm::vec3 rotate_between_frames(const Frame& base, const Frame& offset, glm::vec3 local) {
    glm::vec3 result = offset.to_local(from_pole(offset.normal, to_pole(base.normal, base.to_world(local))));
    result.z = local.z;
    return glm::normalize(result);
}

} // namespace

std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset) {
    const bool transmits = base.to_previous.z * base_to_next.z < 0;
    const float base_index = transmits ? base.bsdf.relative_index(base.to_previous) : 1;
    const float offset_index = transmits ? offset.bsdf.relative_index(offset.to_previous) : 1;
    if ((base_index == 1) != (offset_index == 1))
        return {};
    // Transmission without refraction, as by a thin sheet, is a reflection that is mirrored to the other side.
    const bool refracts = base_index != 1, is_unrefracted = transmits && !refracts;
    if (is_unrefracted)
        base_to_next = across(base_to_next);
    const glm::vec3 half = half_vector(base.to_previous, base_to_next, base_index);
    // A microfacet cannot refract light to the side it came from. Diffuse transmission can, and fails here.
    if (refracts && glm::dot(base.to_previous, half) * glm::dot(base_to_next, half) >= 0)
        return {};
    const glm::vec3 copied = rotate_between_frames(base.frame, offset.frame, half);
    auto to_next =
        refracts ? refract(offset.to_previous, copied, offset_index) : reflect(offset.to_previous, copied);
    // On another side than the base's, the inverse shift would not find this half vector.
    if (!to_next || refracts != (to_next->z * offset.to_previous.z < 0))
        return {};
    // theory (15).
    const float jacobian = half_vector_jacobian(base.to_previous, base_to_next, half, base_index) /
                           half_vector_jacobian(offset.to_previous, *to_next, copied, offset_index);
    if (is_unrefracted)
        to_next = across(*to_next);
    const BsdfValue v = offset.evaluate(*to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    if (!(jacobian > 0) || !std::isfinite(jacobian))
        return {};
    return CopiedScatter{*to_next, v.f_cos, v.pdf_w, jacobian};
}

std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset) {
    const DeltaValue v = offset.evaluate_delta(scatter);
    if (!(v.probability > 0) || is_black(v.value))
        return {};
    return CopiedScatter{v.to_next, v.value, v.probability, 1};
}

} // namespace tessera
