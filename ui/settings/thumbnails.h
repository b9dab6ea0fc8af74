// Thumbnails of recent scenes, in a folder beside the preferences file.
#pragma once

#include "recon/image.h"

#include <filesystem>
#include <string>

namespace tessera {

/// Returns a thumbnail of 160x120 pixels: the middle of the image in 4:3, in sRGB at this exposure, [0, 1].
/// @param image     radiance; at least one pixel
/// @param exposure  stops
RgbImage thumbnail_of(const RgbImage& image, float exposure);

/// Stores the scene's thumbnail, and removes those of scenes that are not among the recent ones of the
/// preferences. Throws std::exception.
/// @param preferences  the preferences file
/// @param scene        absolute name of the scene file
void store_thumbnail(const std::filesystem::path& preferences, const std::string& scene,
                     const RgbImage& thumbnail);

/// Returns the scene's stored thumbnail; empty: there is none, or it cannot be read.
RgbImage read_thumbnail(const std::filesystem::path& preferences, const std::string& scene);

} // namespace tessera
