#include "render/load/text_file.h"

#include "render/load/messages.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace tessera {

namespace {

/// How many bytes the character takes that begins there; 0: they are no UTF-8.
std::size_t length_of_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xc2 ? 0
                               : first < 0xe0 ? 2
                               : first < 0xf0 ? 3
                               : first < 0xf5 ? 4
                                              : 0;
    if (length > text.size())
        return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80)
            return 0;
    return length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = length_of_character(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string latin1_to_utf8(std::string_view text) {
    std::string result;
    result.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80) {
            result += c;
        } else {
            result += static_cast<char>(0xc0 | code >> 6);
            result += static_cast<char>(0x80 | (code & 0x3f));
        }
    }
    return result;
}

} // namespace

std::string read_text(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw LoadError({file.string(), 0, 0}, "this is a folder, not a scene file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw LoadError({file.string(), 0, 0}, std::string("cannot open the file: ") + std::strerror(errno));
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad())
        throw LoadError({file.string(), 0, 0}, "cannot read the file");
    return text;
}

Utf8Text to_utf8(std::string bytes) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
        throw std::runtime_error("the file is in UTF-16; scenes are read in UTF-8");
    if (bytes.find('\0') != std::string::npos)
        throw std::runtime_error("there are NUL bytes in the file; scenes are text in UTF-8");
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.erase(0, 3);
    if (is_utf8(bytes))
        return {std::move(bytes), false};
    return {latin1_to_utf8(bytes), true};
}

} // namespace tessera
