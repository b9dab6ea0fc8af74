#include "app/html.h"

#include "render/load/png.h"

#include <fmt/core.h>

namespace tessera {

namespace {

/// [RFC 4648, 4]
std::string base64(const std::vector<char>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

} // namespace

std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes) {
    return fmt::format(R"(<img width="{}" height="{}" {} src="data:image/png;base64,{}">)", image.width(),
                       image.height(), attributes, base64(encode_png(image, exposure)));
}

} // namespace tessera
