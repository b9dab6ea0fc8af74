#pragma once

#include "recon/image.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A picture of a file, in linear light with Rec. 709 primaries, and its place.
struct Picture {
    RgbImage image;
    /// Rectangles in the pixel coordinates that pictures of one view share: of `image`, and of the view. The image
    /// may be smaller than the view (a crop) or larger (overscan). Formats other than OpenEXR have no crops.
    PixelRect data{}, display{};
    std::vector<std::string> notes{}; ///< what was chosen among several layers, or converted
};

/// Return whether the bytes have the signature of the format. TGA has none.
bool is_png(std::string_view bytes);
bool is_jpeg(std::string_view bytes);
bool is_bmp(std::string_view bytes);

/// An image of three bytes a pixel (red, green, blue), rows from the top.
struct ByteImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

// Decode images in memory with libpng, libjpeg-turbo or stb_image. Grey is repeated, 16-bit values keep their
// upper 8 bits, and alpha is dropped. Gamma and colour spaces stated in the file are ignored, because the scene
// states them. All poll `keep_reading`. They throw std::runtime_error with the reason, also for sizes beyond
// check_image_size() and once `keep_reading` returns false, and OutOfMemory.
ByteImage parse_png(std::string_view bytes, const std::function<bool()>& keep_reading);
/// Decodes the alpha channel of a PNG image, repeated in red, green and blue. Throws if there is none.
ByteImage parse_png_alpha(std::string_view bytes, const std::function<bool()>& keep_reading);
ByteImage parse_jpeg(std::string_view bytes, const std::function<bool()>& keep_reading);
/// Decodes bytes with the signature of BMP as BMP, and all others as TGA.
ByteImage parse_bmp_or_tga(std::string_view bytes, const std::function<bool()>& keep_reading);

/// Returns the image with bytes scaled to [0, 1], without decoding sRGB.
RgbImage to_rgb(const ByteImage& picture);

/// Returns whether the bytes have the signature of a Radiance image (.hdr, .pic).
bool is_radiance(std::string_view bytes);

/// Decodes a Radiance image: RGBE, rows from top to bottom, plain or run-length encoded [Ward, "Real Pixels",
/// Graphics Gems II, 1991]. Polls `keep_reading` at each row. Throws std::runtime_error with the reason, also
/// once `keep_reading` returns false.
RgbImage parse_radiance(std::string_view bytes, const std::function<bool()>& keep_reading);

} // namespace tessera
