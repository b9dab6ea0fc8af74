#include "render/paths/shift.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// Turns v by the shortest arc from one unit vector to another, not to its opposite [Rodrigues].
glm::vec3 turn(glm::vec3 from, glm::vec3 to, glm::vec3 v) {
    const glm::vec3 sum = from + to; // nearly exact where they are nearly opposite
    const float one_and_cosine = 0.5f * glm::dot(sum, sum);
    const glm::vec3 axis = glm::cross(from, to);
    return (one_and_cosine - 1) * v + glm::cross(axis, v) + axis * (glm::dot(axis, v) / one_and_cosine);
}

/// From here normals are turned to: any direction, as long as it is the same for all.
constexpr glm::vec3 pole(0.36f, 0.48f, 0.8f);

/// Normals close to the pole's opposite are turned there first, and then by half a turn about an axis across.
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

/// A direction of the base's frame in the offset's, turned along with the normal: frames themselves may lie about
/// normals in any way, and half vectors of neighbours would then point anywhere. All pixels of a sampling set must
/// agree on the light path that each of them sees: by way of a third one it must be the same. So the turn goes
/// from the base's normal to a pole and on to the offset's; shortest arcs from normal to normal would add up to
/// another one on the way round a triangle. The angle to the normal is kept. (Normals far from the pole are
/// twisted by more: there, half vectors of neighbours on curved surfaces agree less, which is noise, not bias.)
glm::vec3 carry(const Frame& base, const Frame& offset, glm::vec3 local) {
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
    // What goes through a sheet that does not bend it is a reflection, taken to the other side.
    const bool refracts = base_index != 1, goes_across = transmits && !refracts;
    if (goes_across)
        base_to_next = across(base_to_next);
    const glm::vec3 half = half_vector(base.to_previous, base_to_next, base_index);
    // By no facet is light bent that leaves it on the side on which it came, as what is scattered through may.
    if (refracts && glm::dot(base.to_previous, half) * glm::dot(base_to_next, half) >= 0)
        return {};
    const glm::vec3 copied = carry(base.frame, offset.frame, half);
    auto to_next =
        refracts ? refract(offset.to_previous, copied, offset_index) : reflect(offset.to_previous, copied);
    // If it does not go to the same side as the base's, the way back would not find this half vector.
    if (!to_next || refracts != (to_next->z * offset.to_previous.z < 0))
        return {};
    const float jacobian = half_vector_jacobian(base.to_previous, base_to_next, half, base_index) /
                           half_vector_jacobian(offset.to_previous, *to_next, copied, offset_index);
    if (goes_across)
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
