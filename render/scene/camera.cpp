#include "render/scene/camera.h"

#include "recon/enumeration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

/// Half the width of the picture at distance 1 from the camera.
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

constexpr std::string_view axis_names[] = {"x", "y", "diagonal", "smaller", "larger"};

} // namespace

std::string_view to_string(FovAxis axis) {
    return entry_of(axis_names, axis);
}

std::optional<FovAxis> fov_axis_from_name(std::string_view name) {
    const auto found = std::find(std::begin(axis_names), std::end(axis_names), name);
    if (found == std::end(axis_names))
        return {};
    return static_cast<FovAxis>(found - std::begin(axis_names));
}

Projection::Projection(const Camera& camera, glm::ivec2 size) : origin_(camera.to_world[3]) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const float w = half_width(camera.fov, camera.fov_axis, aspect);
    const glm::mat3 to_world(camera.to_world);
    corner_ = to_world * glm::vec3(w, w / aspect, 1);
    right_ = to_world * glm::vec3(-2 * w / static_cast<float>(size.x), 0, 0);
    down_ = to_world * glm::vec3(0, -2 * w / aspect / static_cast<float>(size.y), 0);
    pixel_angle_ = glm::length(right_) / glm::length(to_world[2]); // a scaled camera sees the same
}

glm::vec3 Projection::project(glm::vec3 point) const {
    return glm::inverse(glm::mat3(right_, down_, corner_)) * (point - origin_);
}

Ray Camera::ray(glm::vec2 pixel, glm::ivec2 size) const {
    return Projection(*this, size).ray(pixel);
}

} // namespace tessera
