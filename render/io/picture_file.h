#pragma once

#include "render/io/exr.h"
#include "render/io/picture_formats.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tessera {

/// A decoded picture: three bytes a pixel as stored, or floats. The other is empty.
struct DecodedPicture {
    ByteImage bytes;
    Picture floats;
};

/// Decodes an image file in memory: OpenEXR, Radiance and PFM as floats; PNG, JPEG, BMP and TGA as bytes. The
/// content decides on the format; only TGA, which has no signature, needs its extension ".tga".
/// @param layer  chooses a layer of an OpenEXR file, as choose_layer() in render/io/exr_layers.h; empty: the
/// picture Throws std::runtime_error with the reason, also for a layer of another format, for a size that file or
/// memory cannot hold, and once `watch` (may be empty) returns false.
DecodedPicture decode_picture(std::string_view encoded, std::string_view extension, const std::string& layer = {},
                              const ReadProgress& watch = {});

/// Reads an image file of these formats in linear light. Bytes are sRGB codes. Throws std::runtime_error that
/// names the file.
Picture read_picture(const std::filesystem::path& file, const std::string& layer = {},
                     const ReadProgress& watch = {});

} // namespace tessera
