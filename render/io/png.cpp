#include "render/io/png.h"

#include "render/io/files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace tessera {

namespace {

void append(void* bytes, void* data, int size) {
    auto& out = *static_cast<std::vector<char>*>(bytes);
    const char* first = static_cast<const char*>(data);
    out.insert(out.end(), first, first + size);
}

// The encoder counts bytes by int, of rows that each have one more.
static_assert(3 * most_image_pixels + most_image_edge <= std::numeric_limits<int>::max());

std::vector<char> encode_png(glm::ivec2 size, std::span<const std::uint8_t> rgb) {
    check_image_size(size.x, size.y);
    if (rgb.size() != 3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))
        throw std::runtime_error("there are other than three bytes for each pixel");
    std::vector<char> bytes;
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, 3, rgb.data(), 3 * size.x))
        throw std::runtime_error("the image cannot be encoded");
    return bytes;
}

std::vector<std::uint8_t> srgb_bytes(const RgbImage& image, float exposure) {
    const float scale = std::exp2(exposure);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * image.size());
    for (const Rgb& c : image)
        for (int channel = 0; channel < 3; ++channel)
            rgb.push_back(srgb_byte(scale * c[channel]));
    return rgb;
}

} // namespace

float srgb_encoded(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

std::uint8_t srgb_byte(float linear) {
    if (!(linear > 0)) // comparisons with NaN are false
        return 0;
    return static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(std::min(linear, 1.0f))));
}

void write_png(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> rgb) {
    try {
        const std::vector<char> bytes = encode_png(size, rgb);
        TemporaryFile temporary(path);
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.open(temporary.path(), std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        temporary.commit();
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot write " + path.string() + ": " + error.what());
    }
}

void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure) {
    write_png(path, {image.width(), image.height()}, srgb_bytes(image, exposure));
}

std::vector<char> encode_png(const RgbImage& image, float exposure) {
    return encode_png({image.width(), image.height()}, srgb_bytes(image, exposure));
}

} // namespace tessera
