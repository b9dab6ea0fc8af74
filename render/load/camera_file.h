#pragma once

#include "render/scene/camera.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera {

/// A camera as JSON: "to_world" (16 numbers, row by row as in Mitsuba's <matrix>), "fov" (degrees), "fov_axis"
/// ("x" if absent). "origin", "target" and "up" are written for whoever looks at the file, and not read.

/// Throws LoadError with file, line and column for whatever is broken, missing, unknown, or makes no camera.
Camera read_camera(const std::filesystem::path& file);
/// The same for text in memory; `name` stands in messages.
Camera parse_camera(const std::string& json, const std::string& name);

/// What read_camera makes the same camera of, bit by bit. The last row of the matrix is always 0 0 0 1.
std::string camera_json(const Camera& camera);
/// Writes to a temporary name beside `file` and renames it. Throws std::runtime_error that names the file.
void write_camera(const std::filesystem::path& file, const Camera& camera);

/// What stands for the camera inside a <sensor> of a Mitsuba scene: fov, fov_axis and to_world.
std::string camera_xml(const Camera& camera);

} // namespace tessera
