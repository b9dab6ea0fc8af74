#pragma once

#include "render/surface/texture.h"

#include <filesystem>

namespace tessera {

/// Reads an image file as three channels: OpenEXR and Radiance files as linear floats, others (such as PNG, JPEG,
/// TGA and BMP) as bytes, which are sRGB encoded or linear as `srgb` says. Transparency is dropped, grey repeated.
/// Throws std::runtime_error, also for a size that the file is far too short for.
Bitmap read_bitmap(const std::filesystem::path& file, bool srgb);

} // namespace tessera
