#pragma once

#include "recon/image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Returns the 8-bit sRGB code of a linear value. Values are clamped to [0, 1]; NaN becomes 0.
std::uint8_t srgb_byte(float linear);

/// Writes 8-bit RGB, row by row from the top left, through a TemporaryFile. Throws std::runtime_error that
/// names the file.
void write_png(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> rgb);

/// Writes the image times 2^exposure as sRGB, in the same way.
void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure = 0);

/// Writes the image as sRGB with an alpha channel, in [0, 1], by which colours are not multiplied.
void write_png(const std::filesystem::path& path, const RgbImage& image, const Image<float>& alpha);

/// Returns the bytes that write_png() would write. Throws std::runtime_error.
std::vector<char> encode_png(const RgbImage& image, float exposure = 0);

/// Reads a portable float map: colour ("PF") or grey ("Pf", repeated in all channels), of either byte order.
/// The result's rows run from the top. The magnitude of the scale is ignored, because programs agree only on
/// its sign. Throws std::runtime_error that names the file.
RgbImage read_pfm(const std::filesystem::path& path);

/// Returns whether the bytes begin as a portable float map.
bool is_pfm(std::string_view bytes);

/// Reads a portable float map in memory; errors name no file.
RgbImage parse_pfm(std::string_view bytes);

} // namespace tessera
