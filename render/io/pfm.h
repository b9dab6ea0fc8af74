#pragma once

#include "recon/image.h"

#include <filesystem>
#include <string_view>

namespace tessera {

/// Portable float map, colour ("PF") or grey ("Pf", repeated in all channels), of either byte order; its rows,
/// which go from the bottom up, come out from the top down. The size of the scale is passed over, as its sign
/// alone has a meaning to all programs. Throws std::runtime_error that names the file.
RgbImage read_pfm(const std::filesystem::path& path);

/// Reads the bytes of such a file; the error names none.
RgbImage parse_pfm(std::string_view bytes);

} // namespace tessera
