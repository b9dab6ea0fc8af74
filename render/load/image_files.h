#pragma once

#include "render/scene/texture.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace tessera {

/// An image file as three channels: OpenEXR and Radiance files as linear floats, others (PNG, JPEG, TGA, BMP, ...)
/// as bytes, which are sRGB encoded or linear as `srgb` says. Transparency is dropped, grey repeated. Throws
/// std::runtime_error, also for a size that the file is far too short for.
Bitmap read_bitmap(const std::filesystem::path& file, bool srgb);

/// ".exr": the end of the file's name, in lower case.
std::string extension_of(const std::filesystem::path& file);

/// Throws std::runtime_error unless a file of that many bytes can hold an image of that size, and this program
/// too.
void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes);

} // namespace tessera
