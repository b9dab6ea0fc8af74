#pragma once

#include "render/scene/camera.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Channels of the picture that a film writes, Mitsuba's pixel_format. X, Y, Z are CIE 1931.
enum class PixelFormat : std::uint8_t { luminance, luminance_alpha, rgb, rgba, xyz, xyza };

/// Returns Mitsuba's name of a format: "luminance_alpha".
std::string_view to_string(PixelFormat format);
/// Returns the format with this name, in any case of letters; empty if there is none.
std::optional<PixelFormat> pixel_format_from_name(std::string_view name);
/// Returns whether the format has an alpha channel.
inline bool has_alpha(PixelFormat format) {
    return format == PixelFormat::luminance_alpha || format == PixelFormat::rgba || format == PixelFormat::xyza;
}

/// A camera of a scene file, with its film.
struct Sensor {
    std::string id; ///< empty: none
    Camera camera;
    glm::ivec2 size{768, 576}; ///< of the picture: the crop window, or the film; pixels
    PixelFormat format = PixelFormat::rgb;
};

/// Returns the index of the sensor with this id, or with this number, which counts from 0. Throws
/// std::runtime_error that lists the sensors if there is none.
std::size_t find_sensor(const std::vector<Sensor>& sensors, std::string_view number_or_id);
/// Returns the sensors by number and id: "0, 1 (second)".
std::string list_of(const std::vector<Sensor>& sensors);

} // namespace tessera
