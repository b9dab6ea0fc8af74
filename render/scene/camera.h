#pragma once

#include "render/trace/ray.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace tessera {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// A pinhole with Mitsuba's conventions: looks along +z of `to_world`, +y is up, +x is to the left.
struct Camera {
    glm::mat4 to_world{1.0f};
    float fov = 45; ///< degrees, across fov_axis
    FovAxis fov_axis = FovAxis::x;

    /// The ray through a point of the picture, in pixels from its top left corner. Its direction is unit.
    Ray ray(glm::vec2 pixel, glm::ivec2 size) const;

    bool operator==(const Camera&) const = default;
};

} // namespace tessera
