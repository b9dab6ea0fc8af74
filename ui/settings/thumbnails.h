// Small pictures of recent scenes, which lie in a folder beside the preferences.
#pragma once

#include "recon/image.h"

#include <filesystem>
#include <string>

namespace tessera {

/// A picture of a scene for the gallery: the middle of it in 4:3, as the screen shows it at that exposure; sRGB in
/// [0, 1]. The image is of radiance, and has at least one pixel.
RgbImage thumbnail_of(const RgbImage& image, float exposure);

/// Keeps the scene's, in place of an earlier one, and removes those of scenes that are not among the recent ones
/// of the preferences, so that there are no more than of these. `scene` is its file in full. Throws
/// std::exception.
void store_thumbnail(const std::filesystem::path& preferences, const std::string& scene,
                     const RgbImage& thumbnail);

/// The scene's, as it was stored; empty: there is none that can be read.
RgbImage read_thumbnail(const std::filesystem::path& preferences, const std::string& scene);

} // namespace tessera
