#pragma once

#include "render/trace/rays.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// The name that Mitsuba's "fov_axis" has for it.
std::string_view to_string(FovAxis axis);
/// The axis of that name; empty: there is none.
std::optional<FovAxis> fov_axis_from_name(std::string_view name);

/// A camera with Mitsuba's conventions: looks along +z of `to_world`, +y is up, +x is to the left. Lengths are in
/// its own units: a scale in `to_world` scales them, too.
struct Camera {
    glm::mat4 to_world{1.0f};
    float fov = 45; ///< degrees, across fov_axis; of a perspective
    FovAxis fov_axis = FovAxis::x;
    bool is_orthographic = false;  ///< sees along parallel rays, and 2 of its units across the picture
    glm::vec2 principal_offset{0}; ///< where the picture begins, right and down: shares of its width and height
    float aperture_radius = 0;     ///< of the lens; 0: a pinhole, all is sharp
    float focus_distance = 1;      ///< > 0: of the plane that a lens sees sharply

    /// The ray through a point of the picture, in pixels from its top left corner, and one of the lens, in its
    /// radii.
    Ray ray(glm::vec2 pixel, glm::ivec2 size, glm::vec2 lens = glm::vec2(0)) const;

    bool operator==(const Camera&) const = default;
};

/// How wide a pixel is in the middle of the picture, across the view.
struct PixelWidth {
    float angle = 0; ///< seen from the camera: radians; 0 where rays are parallel
    float least = 0; ///< at the camera, units of the scene; 0 where rays begin at a point

    /// At a distance from the camera, both in units of the scene.
    float at(float distance) const { return angle * distance + least; }
};

/// A camera made ready for one size of picture. Where a ray begins and where it leads are linear in the points of
/// the picture and of the lens that it goes through. A perspective moves its direction over the picture, an
/// orthographic camera its origin; a point beside the middle of the lens is another pinhole, tilted so that the
/// plane in focus stays where it was in the picture.
class Projection {
public:
    Projection(const Camera& camera, glm::ivec2 size);

    /// The ray through a point of the picture, in pixels from its top left corner, and one of the lens, in its
    /// radii; (0, 0) is its middle. Its direction is unit.
    Ray ray(glm::vec2 pixel, glm::vec2 lens = glm::vec2(0)) const {
        return {origin_.at(pixel, lens), glm::normalize(direction_.at(pixel, lens))};
    }

    /// How that ray moves with the point of the picture: by the width of a pixel, and by its height.
    std::array<Ray, 2> ray_derivatives(glm::vec2 pixel, glm::vec2 lens) const {
        const glm::vec3 d = direction_.at(pixel, lens);
        const float length = glm::length(d);
        const glm::vec3 unit = d / length;
        const auto across = [&](glm::vec3 by) { return (by - glm::dot(by, unit) * unit) / length; };
        return {Ray{origin_.right, across(direction_.right)}, Ray{origin_.down, across(direction_.down)}};
    }

    PixelWidth pixel_width() const { return pixel_width_; }

    /// Where a point is seen through one of the lens: pixels from the top left corner times w; its depth, in units
    /// of the camera; and w, which is the depth in a perspective, else 1. All are linear in the point.
    glm::vec4 project(glm::vec3 point, glm::vec2 lens = glm::vec2(0)) const;

private:
    struct Linear {
        glm::vec3 corner{0};            // at the picture's top left corner and the middle of the lens
        glm::vec3 right{0}, down{0};    // what a pixel's width and height add
        glm::vec3 lens_x{0}, lens_y{0}; // what a radius of the lens adds

        glm::vec3 at(glm::vec2 pixel, glm::vec2 lens) const {
            return corner + pixel.x * right + pixel.y * down + lens.x * lens_x + lens.y * lens_y;
        }
    };

    Linear origin_, direction_;
    PixelWidth pixel_width_;
    bool is_orthographic_;
};

// Cameras in files are JSON: "to_world" (16 numbers, row by row as in Mitsuba's <matrix>), "fov" (degrees),
// "fov_axis" ("x" if absent), or instead of both "orthographic": true; and where a camera has such,
// "principal_point_offset" (2 numbers), "aperture_radius" and "focus_distance". "origin", "target" and "up" are
// written for whoever reads the file, and not read back.

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

/// What stands for the camera inside a <sensor> of a Mitsuba scene, such as fov, fov_axis and to_world. The type
/// of sensor that it belongs to stands before it, as a comment, unless that is "perspective".
std::string camera_xml(const Camera& camera);

} // namespace tessera
