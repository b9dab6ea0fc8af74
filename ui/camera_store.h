#pragma once

#include "render/scene/camera.h"

#include <filesystem>

namespace tessera {

/// Writes the camera to NAME-camera.json beside the scene file NAME.xml, or in the current folder where that
/// cannot be done, or where there is no scene file (empty). Returns the file written, in full; throws
/// std::exception that names it.
std::filesystem::path store_camera(const std::filesystem::path& scene_file, const Camera& camera);

} // namespace tessera
