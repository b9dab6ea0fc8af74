#pragma once

#include "render/scene/camera.h"

#include <filesystem>
#include <vector>

namespace tessera {

/// Reads a camera path: a JSON list of cameras, each as in a camera file. Throws LoadError with file, line and
/// column for an empty list and as read_camera().
std::vector<Camera> read_camera_path(const std::filesystem::path& file);

} // namespace tessera
