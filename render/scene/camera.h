#pragma once

#include "render/sampling/pixel_filter.h"
#include "render/trace/rays.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Returns the value of Mitsuba's "fov_axis" for an axis.
std::string_view to_string(FovAxis axis);
/// Returns the axis with this name; empty if there is none.
std::optional<FovAxis> fov_axis_from_name(std::string_view name);

/// The part of a film that is rendered, as Mitsuba's crop window. Pixels.
struct CropWindow {
    glm::ivec2 film{0};   ///< size of the whole film
    glm::ivec2 offset{0}; ///< of the window's top left corner in the film
    glm::ivec2 size{0};   ///< of the window; 0: the whole film is rendered, whatever its size

    bool empty() const { return size.x <= 0; }
    /// Returns whether the window lies within its film.
    bool is_valid() const {
        return offset.x >= 0 && offset.y >= 0 && size.x >= 1 && size.y >= 1 && size.x <= film.x &&
               size.y <= film.y && offset.x <= film.x - size.x && offset.y <= film.y - size.y;
    }
    /// Returns the size of the window on a film of another size, at least one pixel.
    glm::ivec2 size_on(glm::ivec2 other_film) const;
    bool operator==(const CropWindow&) const = default;
};

/// Returns the window as on the command line, without its film: "30,10,40x36"; "none" if it is empty.
std::string text_of(const CropWindow& crop);

/// A camera with Mitsuba's conventions: it looks along +z of `to_world`, +y is up and +x points left. Lengths are
/// in camera space, so a scale in `to_world` scales them.
struct Camera {
    glm::mat4 to_world{1.0f};
    float fov = 45; ///< degrees, along fov_axis; perspective only
    FovAxis fov_axis = FovAxis::x;
    bool is_orthographic = false;  ///< parallel rays; the image is 2 units of camera space wide
    glm::vec2 principal_offset{0}; ///< shift of the image window right and down, fractions of its size
    float aperture_radius = 0;     ///< lens radius; 0: pinhole
    float focus_distance = 1;      ///< distance of the plane in focus, > 0
    CropWindow crop{};             ///< the field of view and the principal offset are those of the whole film
    PixelFilter filter{};          ///< the sensor's own, which FilterKind::scene selects

    /// Returns the ray through an image point (pixels from the top left corner) and a lens point (in lens radii).
    Ray ray(glm::vec2 pixel, glm::ivec2 size, glm::vec2 lens = glm::vec2(0)) const;

    bool operator==(const Camera&) const = default;
};

/// Width of a pixel at the image centre, measured perpendicular to the view.
struct PixelWidth {
    float angle = 0; ///< angle of a pixel seen from the camera, radians; 0 if orthographic
    float least = 0; ///< width at the camera, scene units; 0 for a perspective

    /// Returns w(L) of theory (16), the width at a distance from the camera; both in scene units.
    float at(float distance) const { return angle * distance + least; }
};

/// A camera prepared for one image size. Origin and direction of a ray are linear in its image point and its lens
/// point. Over the image, a perspective varies the direction and an orthographic camera varies the origin. Each
/// lens point acts as a tilted pinhole that maps the plane in focus to the same image points.
class Projection {
public:
    /// @param size  of the picture, pixels. If it is not that of the crop window, film and window are scaled.
    Projection(const Camera& camera, glm::ivec2 size);

    /// Returns the ray through an image point (pixels from the top left corner) and a lens point (in lens radii;
    /// (0, 0) is the centre). The direction is unit.
    Ray ray(glm::vec2 pixel, glm::vec2 lens = glm::vec2(0)) const {
        pixel += offset_;
        return {origin_.at(pixel, lens), glm::normalize(direction_.at(pixel, lens))};
    }

    /// Returns the derivatives of ray() by the image point's x and y, per pixel.
    std::array<Ray, 2> ray_derivatives(glm::vec2 pixel, glm::vec2 lens) const {
        const glm::vec3 d = direction_.at(pixel + offset_, lens);
        const float length = glm::length(d);
        const glm::vec3 unit = d / length;
        const auto across = [&](glm::vec3 by) { return (by - glm::dot(by, unit) * unit) / length; };
        return {Ray{origin_.right, across(direction_.right)}, Ray{origin_.down, across(direction_.down)}};
    }

    PixelWidth pixel_width() const { return pixel_width_; }
    /// Returns the pixel of the whole film at the picture's top left corner; (0, 0) without a crop window.
    glm::ivec2 film_offset() const { return glm::ivec2(offset_ + 0.5f); }

    /// Projects a point as seen through a lens point. Returns (x w, y w, depth, w): x and y in pixels from the
    /// top left corner, the depth in camera units. w is the depth in a perspective, else 1. Linear in the point.
    glm::vec4 project(glm::vec3 point, glm::vec2 lens = glm::vec2(0)) const;

private:
    struct Linear {
        glm::vec3 corner{0};            // value at the film's top left corner and the lens centre
        glm::vec3 right{0}, down{0};    // change per pixel in x and in y
        glm::vec3 lens_x{0}, lens_y{0}; // change per lens radius in x and in y

        glm::vec3 at(glm::vec2 pixel, glm::vec2 lens) const {
            return corner + pixel.x * right + pixel.y * down + lens.x * lens_x + lens.y * lens_y;
        }
    };

    Linear origin_, direction_;
    glm::vec2 offset_{0}; // of the picture in the film, pixels
    PixelWidth pixel_width_;
    bool is_orthographic_;
};

// Camera files are JSON with "to_world" (16 numbers, row by row as in Mitsuba's <matrix>). A perspective has
// "fov" (degrees) and "fov_axis" ("x" by default); otherwise "orthographic" is true. "principal_point_offset" (2
// numbers), "aperture_radius" and "focus_distance" are optional. "origin", "target" and "up" are written for
// human readers and ignored on reading. "crop" has six numbers: size of the film, offset and size of the window.
// "filter" has the reconstruction filter's name and its parameters.

/// Reads a camera file. Throws LoadError with file, line and column if a field is malformed, missing or unknown.
Camera read_camera(const std::filesystem::path& file);
/// Reads a camera path: a JSON list of cameras, each as in a camera file. Throws LoadError for an empty list, and
/// as read_camera() does.
std::vector<Camera> read_camera_path(const std::filesystem::path& file);
/// Parses the text of a camera file; messages call it `name`.
Camera parse_camera(const std::string& json, const std::string& name);

/// Returns the text from which read_camera makes a bitwise equal camera; the matrix always ends with 0 0 0 1.
std::string camera_json(const Camera& camera);
/// Writes camera_json to a temporary file and renames it to `file`. Throws std::runtime_error that names the
/// file.
void write_camera(const std::filesystem::path& file, const Camera& camera);

/// Returns the camera's parameters (fov, fov_axis, to_world, ...) as XML to be placed inside a Mitsuba <sensor>.
/// A comment in front names the sensor's type unless it is "perspective".
std::string camera_xml(const Camera& camera);

} // namespace tessera
