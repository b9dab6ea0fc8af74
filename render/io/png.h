#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// The sRGB code, in [0, 1], of a linear value in [0, 1] [IEC 61966-2-1].
float srgb_encoded(float linear);

/// The 8-bit sRGB code of a linear value: 0 to 1 becomes 0 to 255, the rest is cut, what is not a number becomes
/// 0.
std::uint8_t srgb_byte(float linear);

/// Writes 8-bit RGB, row by row from the top left, to a temporary name beside `path` that is then renamed. Throws
/// std::runtime_error that names the file.
void write_png(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> rgb);

/// Writes the image, times 2^exposure, in sRGB, in the same way.
void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure = 0);

/// The bytes that write_png would write. Throws std::runtime_error.
std::vector<char> encode_png(const RgbImage& image, float exposure = 0);

} // namespace tessera
