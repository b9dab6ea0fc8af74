#include "render/scene/camera.h"

#include "recon/enumeration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

/// Returns half the image's width at distance 1 from the camera.
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

glm::ivec2 CropWindow::size_on(glm::ivec2 other_film) const {
    if (empty())
        return other_film;
    const glm::dvec2 scale = glm::dvec2(other_film) / glm::dvec2(film);
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * scale)), 1);
}

std::string text_of(const CropWindow& crop) {
    return crop.empty() ? "none"
                        : fmt::format("{},{},{}x{}", crop.offset.x, crop.offset.y, crop.size.x, crop.size.y);
}

Projection::Projection(const Camera& camera, glm::ivec2 size) : is_orthographic_(camera.is_orthographic) {
    const glm::mat3 to_world(camera.to_world);
    const glm::vec3 ahead = to_world[2];
    glm::vec2 film(size);
    if (const CropWindow& crop = camera.crop; !crop.empty()) {
        const glm::vec2 scale = glm::vec2(size) / glm::vec2(crop.size);
        film = glm::vec2(crop.film) * scale;
        offset_ = glm::vec2(crop.offset) * scale;
    }
    const float aspect = film.x / film.y;
    const float w = is_orthographic_ ? 1 : half_width(camera.fov, camera.fov_axis, aspect);
    Linear& across = is_orthographic_ ? origin_ : direction_;
    across.right = to_world * glm::vec3(-2 * w / film.x, 0, 0);
    across.down = to_world * glm::vec3(0, -2 * w / aspect / film.y, 0);
    across.corner = to_world * glm::vec3(w, w / aspect, is_orthographic_ ? 0 : 1);
    const glm::vec2 offset = camera.principal_offset * film;
    across.corner += offset.x * across.right + offset.y * across.down;
    origin_.corner += glm::vec3(camera.to_world[3]);
    if (is_orthographic_) {
        direction_.corner = ahead;
        pixel_width_.least = glm::length(across.right);
    } else {
        pixel_width_.angle = glm::length(across.right) / glm::length(ahead); // independent of the camera's scale
    }
    origin_.lens_x = camera.aperture_radius * to_world[0];
    origin_.lens_y = camera.aperture_radius * to_world[1];
    direction_.lens_x = -origin_.lens_x / camera.focus_distance;
    direction_.lens_y = -origin_.lens_y / camera.focus_distance;
}

glm::vec4 Projection::project(glm::vec3 point, glm::vec2 lens) const {
    const Linear& across = is_orthographic_ ? origin_ : direction_;
    const glm::vec3 origin = origin_.at(glm::vec2(0), lens), direction = direction_.at(glm::vec2(0), lens);
    const glm::vec3 seen = glm::inverse(glm::mat3(across.right, across.down, direction)) * (point - origin);
    const float w = is_orthographic_ ? 1 : seen.z;
    return {seen.x - w * offset_.x, seen.y - w * offset_.y, seen.z, w};
}

Ray Camera::ray(glm::vec2 pixel, glm::ivec2 size, glm::vec2 lens) const {
    return Projection(*this, size).ray(pixel, lens);
}

} // namespace tessera
