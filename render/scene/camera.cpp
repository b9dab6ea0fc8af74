#include "render/scene/camera.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

/// Half the width of the picture at distance 1.
float half_width(float fov, FovAxis axis, float aspect) {
    const float t = std::tan(glm::radians(fov) / 2);
    switch (axis) {
    case FovAxis::x:
        return t;
    case FovAxis::y:
        return t * aspect;
    case FovAxis::diagonal:
        return t * aspect / std::sqrt(1 + aspect * aspect);
    case FovAxis::smaller:
        return aspect < 1 ? t : t * aspect;
    case FovAxis::larger:
        return aspect < 1 ? t * aspect : t;
    }
    return t;
}

} // namespace

Ray Camera::ray(glm::vec2 pixel, glm::ivec2 size) const {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const float w = half_width(fov, fov_axis, aspect);
    const glm::vec2 ndc = 1.0f - 2.0f * pixel / glm::vec2(size); // +1 at the left and at the top
    const glm::vec3 local(ndc.x * w, ndc.y * w / aspect, 1);
    return {glm::vec3(to_world[3]), glm::normalize(glm::mat3(to_world) * local)};
}

} // namespace tessera
