#include "render/io/picture_file.h"

#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

namespace tessera {

namespace {

DecodedPicture from_bytes(ByteImage bytes) {
    return {std::move(bytes), {}};
}

DecodedPicture from_floats(RgbImage image) {
    const PixelRect whole{0, 0, image.width(), image.height()};
    return {{}, {std::move(image), whole, whole}};
}

DecodedPicture decode_single_layer(std::string_view encoded, std::string_view extension,
                                   const std::function<bool()>& keep_reading) {
    if (is_radiance(encoded))
        return from_floats(parse_radiance(encoded, keep_reading));
    if (is_pfm(encoded))
        return from_floats(parse_pfm(encoded));
    if (is_png(encoded))
        return from_bytes(parse_png(encoded, keep_reading));
    if (is_jpeg(encoded))
        return from_bytes(parse_jpeg(encoded, keep_reading));
    if (is_bmp(encoded) || extension == ".tga") // TGA has no signature
        return from_bytes(parse_bmp_or_tga(encoded, keep_reading));
    throw std::runtime_error("it is not an OpenEXR, Radiance, PFM, PNG, JPEG, BMP or TGA picture");
}

} // namespace

DecodedPicture decode_picture(std::string_view encoded, std::string_view extension, const std::string& layer,
                              const ReadProgress& watch) {
    if (is_exr(encoded))
        return {{}, parse_exr_picture(encoded, layer, watch)};
    DecodedPicture picture = decode_single_layer(encoded, extension, [&] { return !watch || watch(0); });
    if (!layer.empty())
        throw std::runtime_error("it has no layers: only OpenEXR files have");
    return picture;
}

Picture read_picture(const std::filesystem::path& file, const std::string& layer, const ReadProgress& watch) {
    try {
        DecodedPicture decoded = decode_picture(read_bytes(file), extension_of(file), layer, watch);
        if (decoded.bytes.rgb.empty())
            return std::move(decoded.floats);
        RgbImage image = to_rgb(decoded.bytes);
        std::ranges::transform(image, image.begin(), [](Rgb c) {
            return Rgb(srgb_to_linear(c.r), srgb_to_linear(c.g), srgb_to_linear(c.b));
        });
        return from_floats(std::move(image)).floats;
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + file.string() + ": " + message_of(error));
    }
}

} // namespace tessera
