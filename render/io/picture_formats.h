#pragma once

#include "recon/image.h"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace tessera {

/// Whether the bytes begin as a picture of that format does. TGA has no mark.
bool is_png(std::string_view bytes);
bool is_jpeg(std::string_view bytes);
bool is_bmp(std::string_view bytes);

/// A picture of three bytes a pixel, red, green and blue, rows from the top.
struct ByteImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

// Pictures in memory, by libpng, libjpeg-turbo and stb_image. Grey is repeated, of 16 bits the upper 8 are taken,
// transparency is dropped, and what the file says of gamma and colour spaces is not heeded: that is the scene's to
// say. All throw std::runtime_error that says what is wrong, for sizes beyond check_image_size, OutOfMemory, and
// once `wanted`, asked now and then, wants the picture no more.
ByteImage parse_png(std::string_view bytes, const std::function<bool()>& wanted);
ByteImage parse_jpeg(std::string_view bytes, const std::function<bool()>& wanted);
/// What begins as a BMP picture does is one, anything else a TGA.
ByteImage parse_bmp_or_tga(std::string_view bytes, const std::function<bool()>& wanted);

/// The picture with its bytes as they are, in [0, 1].
RgbImage to_rgb(const ByteImage& picture);

/// Whether the bytes begin as a Radiance picture (.hdr, .pic) does.
bool is_radiance(std::string_view bytes);

/// Reads a Radiance picture: RGBE, rows from the top to the bottom, plain or run-length encoded [Ward, "Real
/// Pixels", Graphics Gems II, 1991]. Throws std::runtime_error that says what is wrong with it, also where
/// `wanted`, asked at each row, wants it no more.
RgbImage parse_radiance(std::string_view bytes, const std::function<bool()>& wanted);

} // namespace tessera
