// Maps of the errors of a picture, as EXR or PNG.
#pragma once

#include "app/compare/picture_comparison.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Error of each pixel of image I relative to reference r.
enum class MapKind {
    squared,   ///< (I - r)^2, mean of the channels
    relative,  ///< (I - r)^2 / (r^2 + relative_mse_epsilon), mean of the channels
    flip,      ///< flip() in recon/metrics/seen_error.h
    difference ///< I - r, with sign, for each channel
};

/// A map to write.
struct MapFile {
    MapKind kind;
    std::filesystem::path path; ///< .exr or .png
};

/// Parses KIND=FILE. Throws BadInput that names kinds or extensions.
MapFile parse_map(const std::string& word);

/// Returns the file of the map of picture `index` (from 0) of `count`: "flip.png", or "flip-1.png" and so on if
/// there are several.
std::filesystem::path map_path(const MapFile& map, std::size_t index, std::size_t count);

/// Writes the map. EXR has the values as they are, NaN where a pixel is not finite in one of the pictures: one
/// channel Y, or R, G and B of a difference. PNG has false colours from violet to yellow for values from 0 to 1 of
/// FLIP, and from 1e-4 to 1, on a logarithmic scale, of squared and relative errors; a difference of d has the
/// sRGB code (1 + d) / 2. Throws std::runtime_error that names the file.
void write_map(const std::filesystem::path& path, MapKind kind, const AlignedPictures& pictures);

} // namespace tessera
