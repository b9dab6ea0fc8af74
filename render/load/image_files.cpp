#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <stb_image.h>

namespace tessera {

namespace {

/// Dark where the file holds what is no light, so that it cannot spread.
Rgb finite(Rgb c) {
    for (int i = 0; i < 3; ++i)
        c[i] = std::isfinite(c[i]) ? c[i] : 0.0f;
    return c;
}

Bitmap read_exr_bitmap(const std::filesystem::path& file) {
    const ExrFile exr = read_exr(file);
    if (exr.layers.empty() || exr.layers.front().image.empty())
        throw std::runtime_error("there is no RGB image in it");
    const auto plain = std::find_if(exr.layers.begin(), exr.layers.end(),
                                    [](const ExrLayer& layer) { return layer.name.empty(); });
    const RgbImage& image = plain != exr.layers.end() ? plain->image : exr.layers.front().image;
    Bitmap bitmap;
    bitmap.width = image.width();
    bitmap.height = image.height();
    bitmap.srgb = false;
    bitmap.floats.resize(image.size());
    std::transform(image.begin(), image.end(), bitmap.floats.begin(), finite);
    return bitmap;
}

template <class T>
using StbPixels = std::unique_ptr<T, void (*)(void*)>;

template <class T>
StbPixels<T> checked(T* pixels) {
    if (!pixels)
        throw std::runtime_error(std::string("not a readable image: ") + stbi_failure_reason());
    return StbPixels<T>(pixels, stbi_image_free);
}

Bitmap read_stb_bitmap(const std::filesystem::path& file, bool srgb) {
    const std::string encoded = read_bytes(file);
    const auto* data = reinterpret_cast<const stbi_uc*>(encoded.data());
    if (encoded.size() > (std::size_t{1} << 30))
        throw std::runtime_error("the image file is too large");
    const int size = static_cast<int>(encoded.size());
    Bitmap bitmap;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &bitmap.width, &bitmap.height, &channels))
        throw std::runtime_error(std::string("not a readable image: ") + stbi_failure_reason());
    check_image_size(bitmap.width, bitmap.height, encoded.size());
    const std::size_t pixels = static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height);
    if (stbi_is_hdr_from_memory(data, size)) {
        const auto floats =
            checked(stbi_loadf_from_memory(data, size, &bitmap.width, &bitmap.height, &channels, 3));
        bitmap.srgb = false;
        bitmap.floats.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            bitmap.floats[i] = finite({floats.get()[3 * i], floats.get()[3 * i + 1], floats.get()[3 * i + 2]});
    } else {
        const auto bytes = checked(stbi_load_from_memory(data, size, &bitmap.width, &bitmap.height, &channels, 3));
        bitmap.srgb = srgb;
        bitmap.bytes.assign(bytes.get(), bytes.get() + 3 * pixels);
    }
    return bitmap;
}

} // namespace

Bitmap read_bitmap(const std::filesystem::path& file, bool srgb) {
    return extension_of(file) == ".exr" ? read_exr_bitmap(file) : read_stb_bitmap(file, srgb);
}

} // namespace tessera
