#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// What a linear value of [0, 1] becomes in sRGB, likewise (IEC 61966-2-1).
float srgb_encoded(float linear);

/// The 8-bit sRGB code of a linear value: 0 to 1 becomes 0 to 255, the rest is cut, what is not a number becomes
/// 0.
std::uint8_t srgb_byte(float linear);

/// Writes 8-bit RGB, row by row from the top left, to a temporary name beside `path` that is then renamed. Throws
/// std::runtime_error that names the file.
void write_png(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> rgb);

/// The same for the image, times 2^exposure, in sRGB.
void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure = 0);

/// The file's bytes of the same. Throws std::runtime_error.
std::vector<char> encode_png(const RgbImage& image, float exposure = 0);

} // namespace tessera
