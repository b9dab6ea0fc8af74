#include "render/io/plain_images.h"

#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/text.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
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

// The encoder counts bytes in an int, with one extra byte a row.
static_assert(4 * max_image_pixels + max_image_edge <= std::numeric_limits<int>::max());

/// @param channels  bytes a pixel, 3 or 4
std::vector<char> encode_png(glm::ivec2 size, std::span<const std::uint8_t> pixels, int channels = 3) {
    check_image_size(size.x, size.y);
    if (pixels.size() !=
        static_cast<std::size_t>(channels) * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))
        throw std::runtime_error(channels == 3 ? "the image does not have three bytes a pixel"
                                               : "the image does not have four bytes a pixel");
    std::vector<char> bytes;
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, channels, pixels.data(), channels * size.x))
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

std::uint8_t srgb_byte(float linear) {
    if (!(linear > 0)) // comparisons with NaN are false
        return 0;
    return static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::min(linear, 1.0f))));
}

namespace {

/// Writes a PNG of 3 or 4 bytes a pixel.
void write_pixels(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> pixels,
                  int channels) {
    try {
        const std::vector<char> bytes = encode_png(size, pixels, channels);
        TemporaryFile temporary(path);
        errno = 0;
        std::ofstream out(temporary.path(), std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out)
            throw std::runtime_error(errno != 0 ? std::strerror(errno) : "writing failed");
        temporary.commit();
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot write " + path.string() + ": " + message_of(error));
    }
}

} // namespace

void write_png(const std::filesystem::path& path, glm::ivec2 size, std::span<const std::uint8_t> rgb) {
    write_pixels(path, size, rgb, 3);
}

void write_png(const std::filesystem::path& path, const RgbImage& image, float exposure) {
    write_png(path, {image.width(), image.height()}, srgb_bytes(image, exposure));
}

void write_png(const std::filesystem::path& path, const RgbImage& image, const Image<float>& alpha) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * image.size());
    for (std::size_t i = 0; i < image.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel)
            rgba.push_back(srgb_byte(image.data()[i][channel]));
        rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(alpha.data()[i], 0.0f, 1.0f))));
    }
    write_pixels(path, {image.width(), image.height()}, rgba, 4);
}

std::vector<char> encode_png(const RgbImage& image, float exposure) {
    return encode_png({image.width(), image.height()}, srgb_bytes(image, exposure));
}

namespace {

constexpr std::string_view white_space = " \t\r\n";

struct PfmHeader {
    int width, height;
    int channels; ///< 3 or 1
    bool is_little_endian;
};

/// Takes the header's next word, and the one character that ends it.
std::string_view take_word(std::string_view& bytes) {
    bytes.remove_prefix(std::min(bytes.find_first_not_of(white_space), bytes.size()));
    const std::size_t length = bytes.find_first_of(white_space);
    if (length == std::string_view::npos)
        throw std::runtime_error("the file ends within its header");
    const std::string_view word = bytes.substr(0, length);
    bytes.remove_prefix(length + 1);
    return word;
}

double take_number(std::string_view& bytes, const std::string& name) {
    const std::string_view word = take_word(bytes);
    const std::optional<double> number = parse_number(word);
    if (!number)
        throw std::runtime_error("its " + name + " is not a number: '" + std::string(word.substr(0, 40)) + "'");
    return *number;
}

/// Takes a width or height in pixels. check_image_size() rejects invalid sizes later.
std::int64_t take_length(std::string_view& bytes, const std::string& name) {
    const double number = take_number(bytes, name);
    if (std::trunc(number) != number)
        throw std::runtime_error("its " + name + " is not a whole number of pixels");
    return static_cast<std::int64_t>(std::clamp(number, -1e15, 1e15));
}

/// Takes the header, so that only pixels are left.
PfmHeader take_header(std::string_view& bytes) {
    const std::size_t file_bytes = bytes.size();
    if (!bytes.starts_with("PF") && !bytes.starts_with("Pf"))
        throw std::runtime_error("it is not a PFM file, which begins with PF or Pf");
    const std::string_view kind = take_word(bytes);
    if (kind.size() != 2)
        throw std::runtime_error("its kind is '" + std::string(kind.substr(0, 40)) + "', not PF or Pf");
    const std::int64_t width = take_length(bytes, "width"), height = take_length(bytes, "height");
    check_image_size(width, height, file_bytes);
    const double scale = take_number(bytes, "scale");
    if (scale == 0)
        throw std::runtime_error("its scale is 0, and gives no byte order");
    // One character ends the header, unless lines end in \r\n.
    if (bytes.data()[-1] == '\r' && bytes.starts_with('\n'))
        bytes.remove_prefix(1);
    return {static_cast<int>(width), static_cast<int>(height), kind == "PF" ? 3 : 1, scale < 0};
}

float read_float(const char* bytes, bool is_little_endian) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i)
        bits = bits << 8 | static_cast<unsigned char>(bytes[is_little_endian ? 3 - i : i]);
    return std::bit_cast<float>(bits);
}

} // namespace

bool is_pfm(std::string_view bytes) {
    return bytes.size() > 2 && (bytes.starts_with("PF") || bytes.starts_with("Pf")) &&
           white_space.find(bytes[2]) != std::string_view::npos;
}

RgbImage parse_pfm(std::string_view bytes) {
    const PfmHeader header = take_header(bytes);
    const std::size_t pixel_bytes = sizeof(float) * static_cast<std::size_t>(header.channels);
    const std::size_t expected =
        pixel_bytes * static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
    if (bytes.size() != expected)
        throw std::runtime_error("it has " + std::to_string(bytes.size()) + " bytes of pixels, not the " +
                                 std::to_string(expected) + " of " + std::to_string(header.width) + " by " +
                                 std::to_string(header.height) + " pixels");
    RgbImage image(header.width, header.height);
    const char* pixel = bytes.data();
    for (int y = header.height - 1; y >= 0; --y)
        for (int x = 0; x < header.width; ++x, pixel += pixel_bytes)
            for (int i = 0; i < 3; ++i)
                image(x, y)[i] =
                    read_float(pixel + (header.channels == 3 ? sizeof(float) * static_cast<std::size_t>(i) : 0),
                               header.is_little_endian);
    return image;
}

RgbImage read_pfm(const std::filesystem::path& path) {
    try {
        return parse_pfm(read_bytes(path));
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + path.string() + ": " + message_of(error));
    }
}

} // namespace tessera
