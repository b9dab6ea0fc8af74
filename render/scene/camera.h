#pragma once

#include "render/trace/rays.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace tessera {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// The name that Mitsuba's "fov_axis" has for it.
std::string_view to_string(FovAxis axis);
/// The axis of that name; empty: there is none.
std::optional<FovAxis> fov_axis_from_name(std::string_view name);

/// A pinhole with Mitsuba's conventions: looks along +z of `to_world`, +y is up, +x is to the left.
struct Camera {
    glm::mat4 to_world{1.0f};
    float fov = 45; ///< degrees, across fov_axis
    FovAxis fov_axis = FovAxis::x;

    /// The ray through a point of the picture, in pixels from its top left corner.
    Ray ray(glm::vec2 pixel, glm::ivec2 size) const;

    bool operator==(const Camera&) const = default;
};

/// A camera made ready for one size of picture.
class Projection {
public:
    Projection(const Camera& camera, glm::ivec2 size);

    /// The ray through a point of the picture, in pixels from its top left corner. Its direction is unit.
    Ray ray(glm::vec2 pixel) const {
        return {origin_, glm::normalize(corner_ + pixel.x * right_ + pixel.y * down_)};
    }

    /// A pixel's width in the middle of the picture, seen from the camera: radians.
    float pixel_angle() const { return pixel_angle_; }

    /// Where a point is seen: pixels from the top left corner times w, and w, which is linear in the point and
    /// above 0 in front of the camera.
    glm::vec3 project(glm::vec3 point) const;

private:
    glm::vec3 origin_;
    glm::vec3 corner_;       // direction of the top left corner
    glm::vec3 right_, down_; // a pixel's width and height
    float pixel_angle_;
};

// Cameras in files are JSON: "to_world" (16 numbers, row by row as in Mitsuba's <matrix>), "fov" (degrees),
// "fov_axis" ("x" if absent). "origin", "target" and "up" are written for whoever reads the file, and not read
// back.

/// Reads a file with a camera. Throws LoadError with file, line and column for whatever is broken, missing,
/// unknown, or makes no camera.
Camera read_camera(const std::filesystem::path& file);
/// Reads such a text in memory; `name` stands in messages.
Camera parse_camera(const std::string& json, const std::string& name);

/// The text of which read_camera makes the same camera, bit by bit. The last row of the matrix is always 0 0 0 1.
std::string camera_json(const Camera& camera);
/// Writes camera_json to a temporary name beside `file` and renames it. Throws std::runtime_error that names the
/// file.
void write_camera(const std::filesystem::path& file, const Camera& camera);

/// What stands for the camera inside a <sensor> of a Mitsuba scene: fov, fov_axis and to_world.
std::string camera_xml(const Camera& camera);

} // namespace tessera
