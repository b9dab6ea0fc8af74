#include "render/io/available_memory.h"
#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/io/radiance.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>

// stb_image takes what a file holds for whatever it looks like, formats that we say nothing of among them (its
// reader of Softimage pictures crashes): only those that are listed are built, and one is chosen before it is
// called.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace tessera {

namespace {

enum class ImageFormat { exr, radiance, png, jpeg, bmp, tga };

/// The format by the first bytes, whatever the file is called. TGA alone has no mark: there the name must say it.
ImageFormat format_of(std::string_view bytes, std::string_view extension) {
    if (bytes.starts_with("\x76\x2f\x31\x01"))
        return ImageFormat::exr;
    if (is_radiance(bytes))
        return ImageFormat::radiance;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"))
        return ImageFormat::png;
    if (bytes.starts_with("\xff\xd8\xff"))
        return ImageFormat::jpeg;
    if (bytes.starts_with("BM"))
        return ImageFormat::bmp;
    if (extension == ".tga")
        return ImageFormat::tga;
    throw std::runtime_error("it is no OpenEXR, Radiance, PNG, JPEG, BMP or TGA picture");
}

/// Dark where the file holds what is no light, so that it cannot spread, and nowhere too bright.
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

/// Bytes in memory as stb_image asks for them: they come to an end as soon as the picture is wanted no more.
struct Source {
    std::string_view left;
    const std::function<bool()>& wanted;

    static int read(void* user, char* data, int size) {
        auto& source = *static_cast<Source*>(user);
        if (!source.wanted())
            source.left = {};
        const std::size_t count = std::min(static_cast<std::size_t>(size), source.left.size());
        std::memcpy(data, source.left.data(), count);
        source.left.remove_prefix(count);
        return static_cast<int>(count);
    }
    static void skip(void* user, int count) {
        auto& source = *static_cast<Source*>(user); // never back: stb_image would do so only within its own buffer
        source.left.remove_prefix(std::min(static_cast<std::size_t>(std::max(count, 0)), source.left.size()));
    }
    static int is_at_end(void* user) { return static_cast<Source*>(user)->left.empty(); }

    static constexpr stbi_io_callbacks callbacks{read, skip, is_at_end};
};

Bitmap parse_bytes(std::string_view encoded, bool srgb, const std::function<bool()>& wanted) {
    const auto fail = [] {
        throw std::runtime_error(std::string("it is no readable picture: ") + stbi_failure_reason());
    };
    Bitmap bitmap;
    bitmap.srgb = srgb;
    int channels = 0;
    Source head{encoded, wanted}, all{encoded, wanted};
    if (!stbi_info_from_callbacks(&Source::callbacks, &head, &bitmap.width, &bitmap.height, &channels))
        fail();
    check_image_size(bitmap.width, bitmap.height, encoded.size());
    const auto pixels = static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height);
    ask_for_memory(12 * pixels, "its pixels"); // three bytes each, and what the decoders have beside them
    const std::unique_ptr<stbi_uc, void (*)(void*)> bytes(
        stbi_load_from_callbacks(&Source::callbacks, &all, &bitmap.width, &bitmap.height, &channels, 3),
        stbi_image_free);
    if (!wanted())
        throw std::runtime_error("it is wanted no more");
    if (!bytes)
        fail();
    bitmap.bytes.assign(bytes.get(), bytes.get() + 3 * pixels);
    return bitmap;
}

} // namespace

Bitmap parse_bitmap(std::string_view encoded, std::string_view extension, bool srgb,
                    const std::function<bool()>& wanted) {
    switch (format_of(encoded, extension)) {
    case ImageFormat::exr:
        return bitmap_of(parse_exr_picture(encoded, [&](float) { return wanted(); }));
    case ImageFormat::radiance:
        return bitmap_of(parse_radiance(encoded, wanted));
    default:
        return parse_bytes(encoded, srgb, wanted);
    }
}

Bitmap read_bitmap(const std::filesystem::path& file, bool srgb, const std::function<bool()>& wanted) {
    return parse_bitmap(read_bytes(file), extension_of(file), srgb, wanted);
}

} // namespace tessera
