#include "render/io/files.h"
#include "render/io/picture_file.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace tessera {

namespace {

/// Replaces infinite and NaN channels by 0, so that they cannot spread, and clamps the others to `brightest`.
Rgb bounded(Rgb c) {
    for (int i = 0; i < 3; ++i)
        c[i] = std::isfinite(c[i]) ? std::min(c[i], brightest) : 0.0f;
    return c;
}

Bitmap bitmap_of(RgbImage image) {
    Bitmap bitmap;
    bitmap.width = image.width();
    bitmap.height = image.height();
    bitmap.srgb = false;
    bitmap.floats = image.take_pixels();
    std::ranges::transform(bitmap.floats, bitmap.floats.begin(), bounded);
    return bitmap;
}

Bitmap bitmap_of(ByteImage image, bool srgb) {
    return {image.width, image.height, srgb, std::move(image.rgb), {}};
}

/// Copies one channel to the others.
void repeat(Bitmap& bitmap, int channel) {
    for (std::size_t i = 0; i + 2 < bitmap.bytes.size(); i += 3)
        std::fill_n(&bitmap.bytes[i], 3, bitmap.bytes[i + static_cast<std::size_t>(channel)]);
    for (Rgb& color : bitmap.floats)
        color = Rgb(color[channel]);
}

} // namespace

LoadedBitmap parse_bitmap(std::string_view encoded, std::string_view extension, bool srgb,
                          const std::function<bool()>& keep_reading) {
    DecodedPicture picture = decode_picture(encoded, extension, {}, [&](float) { return keep_reading(); });
    if (!picture.bytes.rgb.empty())
        return {bitmap_of(std::move(picture.bytes), srgb), {}};
    std::string notes;
    for (const std::string& note : picture.floats.notes)
        notes += (notes.empty() ? "" : "; ") + note;
    return {bitmap_of(std::move(picture.floats.image)), std::move(notes)};
}

LoadedBitmap read_bitmap(const std::filesystem::path& file, bool srgb, const std::function<bool()>& keep_reading,
                         BitmapChannel channel) {
    const std::string bytes = read_bytes(file);
    if (channel == BitmapChannel::alpha) {
        if (!is_png(bytes))
            throw std::runtime_error("the alpha channel is read from PNG pictures only");
        return {bitmap_of(parse_png_alpha(bytes, keep_reading), srgb), {}};
    }
    LoadedBitmap loaded = parse_bitmap(bytes, extension_of(file), srgb, keep_reading);
    if (channel != BitmapChannel::all)
        repeat(loaded.bitmap, channel == BitmapChannel::red ? 0 : channel == BitmapChannel::green ? 1 : 2);
    return loaded;
}

} // namespace tessera
