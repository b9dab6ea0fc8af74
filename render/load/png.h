#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>

namespace tessera {

/// The 8-bit sRGB code of a linear value: 0 to 1 becomes 0 to 255, the rest is cut, what is not a number becomes
/// 0.
std::uint8_t srgb_byte(float linear);

/// Writes the image, times 2^exposure, as an 8-bit sRGB PNG, to a temporary name beside `path` that is then
/// renamed. Throws std::runtime_error that names the file.
void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure = 0);

} // namespace tessera
