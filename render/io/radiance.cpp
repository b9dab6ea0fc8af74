#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/picture_formats.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace tessera {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr std::string_view signatures[] = {"#?RADIANCE\n", "#?RGBE\n"};

/// Takes bytes from the front. Throws std::runtime_error at the end.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : left_(bytes) {}

    std::uint8_t next() {
        if (left_.empty())
            throw std::runtime_error("the file ends too early");
        const auto byte = static_cast<std::uint8_t>(left_.front());
        left_.remove_prefix(1);
        return byte;
    }
    Rgbe pixel() {
        Rgbe p{};
        for (std::uint8_t& byte : p)
            byte = next();
        return p;
    }
    std::string line() {
        std::string text;
        for (char c; (c = static_cast<char>(next())) != '\n';)
            text += c;
        return text;
    }
    std::string_view left() const { return left_; }

private:
    std::string_view left_;
};

/// Reads a row whose four channels are run-length encoded one after the other. A count above 128 repeats the
/// next byte; a smaller one precedes that many literal bytes. A count of 0 would never end, and one beyond the
/// row would overflow: both throw.
void read_runs(Bytes& bytes, std::vector<Rgbe>& row) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = bytes.next();
            const bool repeats = code > 128;
            const std::size_t count = repeats ? code - 128u : code;
            if (count == 0 || count > row.size() - x)
                throw std::runtime_error("a run of pixels does not fit its row");
            for (std::size_t i = 0; i < count; ++i)
                row[x + i][channel] = repeats && i > 0 ? row[x][channel] : bytes.next();
            x += count;
        }
    }
}

void read_row(Bytes& bytes, std::vector<Rgbe>& row) {
    const std::size_t width = row.size();
    const std::string_view left = bytes.left();
    const bool has_runs = width >= 8 && width < 32768 && left.size() >= 4 && left[0] == 2 && left[1] == 2 &&
                          (static_cast<std::uint8_t>(left[2]) & 0x80) == 0;
    if (has_runs) {
        const Rgbe head = bytes.pixel();
        if ((std::size_t{head[2]} << 8 | head[3]) != width)
            throw std::runtime_error("a row's width differs from the picture's");
        return read_runs(bytes, row);
    }
    for (Rgbe& pixel : row)
        pixel = bytes.pixel();
}

Rgb color_of(const Rgbe& p) {
    const float unit = p[3] == 0 ? 0.0f : std::ldexp(1.0f, p[3] - (128 + 8));
    return unit * Rgb(p[0], p[1], p[2]);
}

} // namespace

bool is_radiance(std::string_view bytes) {
    return bytes.starts_with(signatures[0]) || bytes.starts_with(signatures[1]);
}

RgbImage parse_radiance(std::string_view encoded, const std::function<bool()>& keep_reading) {
    Bytes bytes(encoded);
    bool is_rgbe = false;
    for (std::string line = bytes.line(); !line.empty(); line = bytes.line())
        is_rgbe |= line == "FORMAT=32-bit_rle_rgbe";
    if (!is_rgbe)
        throw std::runtime_error("its FORMAT is not 32-bit_rle_rgbe");
    const std::string resolution = bytes.line();
    int width = 0, height = 0, used = 0;
    if (std::sscanf(resolution.c_str(), "-Y %6d +X %6d%n", &height, &width, &used) != 2 ||
        static_cast<std::size_t>(used) != resolution.size())
        throw std::runtime_error("its rows do not run from the top left: \"" + resolution.substr(0, 40) + "\"");
    check_image_size(width, height, encoded.size());
    require_memory(sizeof(Rgb) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height),
                   "its pixels");
    RgbImage image(width, height);
    std::vector<Rgbe> row(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        if (!keep_reading())
            throw std::runtime_error("reading was cancelled");
        read_row(bytes, row);
        for (int x = 0; x < width; ++x)
            image(x, y) = color_of(row[x]);
    }
    return image;
}

} // namespace tessera
