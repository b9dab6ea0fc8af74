#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

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

/// Portable float map, colour ("PF") or grey ("Pf", repeated in all channels), of either byte order; its rows,
/// which go from the bottom up, come out from the top down. The size of the scale is passed over, as its sign
/// alone has a meaning to all programs. Throws std::runtime_error that names the file.
RgbImage read_pfm(const std::filesystem::path& path);

/// Reads the bytes of such a file; the error names none.
RgbImage parse_pfm(std::string_view bytes);

} // namespace tessera
