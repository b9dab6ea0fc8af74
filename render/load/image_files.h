#pragma once

#include "render/surface/texture.h"

#include <filesystem>

namespace tessera {

/// An image file as three channels: OpenEXR and Radiance files as linear floats, others (PNG, JPEG, TGA, BMP, ...)
/// as bytes, which are sRGB encoded or linear as `srgb` says. Transparency is dropped, grey repeated. Throws
/// std::runtime_error, also for a size that the file is far too short for.
Bitmap read_bitmap(const std::filesystem::path& file, bool srgb);

} // namespace tessera
