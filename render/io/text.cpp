#include "render/io/text.h"

#include "render/io/files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

namespace tessera {

namespace {

// Longest excerpt of a source line, which may hold a whole file. Fits a line of a terminal.
constexpr std::size_t max_excerpt = 150;

/// Returns the number of code points of UTF-8 text, which approximates its columns in a terminal.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

std::string with_caret(const std::string& source_line, int column) {
    std::string line = source_line;
    std::replace_if(line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    if (column < 1)
        return "\n    " + line.substr(0, max_excerpt);
    std::size_t at = std::min(static_cast<std::size_t>(column - 1), line.size());
    std::string prefix;
    if (at > max_excerpt * 2 / 3) {
        const std::size_t cut = at - max_excerpt / 2;
        line.erase(0, cut);
        at -= cut;
        prefix = "...";
    }
    const std::size_t caret = prefix.size() + width_of(line.substr(0, at));
    return "\n    " + prefix + line.substr(0, max_excerpt) + "\n    " + std::string(caret, ' ') + "^";
}

} // namespace

std::string FilePosition::to_string() const {
    std::string result = file;
    if (line > 0)
        result += ":" + std::to_string(line);
    if (line > 0 && column > 0)
        result += ":" + std::to_string(column);
    return result;
}

LoadError::LoadError(const FilePosition& where, const std::string& text, const std::string& source_line)
    : std::runtime_error(where.to_string() + ": " + text +
                         (source_line.empty() ? std::string() : with_caret(source_line, where.column))),
      where_(where), text_(text) {}

namespace {

/// Returns the number of bytes of the first character; 0: invalid UTF-8.
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

void append_utf8(std::string& text, char32_t code) {
    const auto append = [&](char32_t byte) { text += static_cast<char>(byte); };
    const auto append_rest = [&](int shift) { append(0x80 | (code >> shift & 0x3f)); };
    if (code < 0x80) {
        append(code);
    } else if (code < 0x800) {
        append(0xc0 | code >> 6);
        append_rest(0);
    } else if (code < 0x10000) {
        append(0xe0 | code >> 12);
        append_rest(6);
        append_rest(0);
    } else {
        append(0xf0 | code >> 18);
        append_rest(12);
        append_rest(6);
        append_rest(0);
    }
}

std::string latin1_to_utf8(std::string_view text) {
    std::string result;
    result.reserve(text.size() + text.size() / 8);
    for (const char c : text)
        append_utf8(result, static_cast<unsigned char>(c));
    return result;
}

enum class ByteOrder { little, big };

/// Returns the byte order of a text in UTF-16; empty: another encoding.
std::optional<ByteOrder> utf16_order(std::string_view bytes) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("<\0"sv))
        return ByteOrder::little;
    if (bytes.starts_with("\xfe\xff") || bytes.starts_with("\0<"sv))
        return ByteOrder::big;
    return {};
}

std::string utf16_to_utf8(std::string_view text, ByteOrder order) {
    constexpr char32_t byte_order_mark = 0xfeff;
    const auto is_between = [](char32_t code, char32_t first, char32_t last) {
        return code >= first && code <= last;
    };
    const auto unit = [&](std::size_t i) -> char32_t {
        const auto first = static_cast<unsigned char>(text[i]), second = static_cast<unsigned char>(text[i + 1]);
        return order == ByteOrder::little ? second << 8 | first : first << 8 | second;
    };
    std::string result;
    result.reserve(text.size() / 2);
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        char32_t code = unit(i);
        if (is_between(code, 0xd800, 0xdbff) && i + 3 < text.size() && is_between(unit(i + 2), 0xdc00, 0xdfff)) {
            code = 0x10000 + ((code - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
            i += 2;
        } else if (is_between(code, 0xd800, 0xdfff)) {
            throw std::runtime_error("the file is not valid UTF-16");
        }
        if (code != byte_order_mark || i > 0)
            append_utf8(result, code);
    }
    if (text.size() % 2 != 0)
        throw std::runtime_error("the file is not valid UTF-16");
    return result;
}

} // namespace

std::string read_text(const std::filesystem::path& file) {
    try {
        return read_bytes(file);
    } catch (const std::runtime_error& error) {
        throw LoadError({file.string(), 0, 0}, error.what());
    }
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

Utf8Text to_utf8(std::string bytes) {
    if (const std::optional<ByteOrder> order = utf16_order(bytes))
        bytes = utf16_to_utf8(bytes, *order);
    if (bytes.find('\0') != std::string::npos)
        throw std::runtime_error("there are NUL bytes in the file; scenes are text in UTF-8 or UTF-16");
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.erase(0, 3);
    if (is_utf8(bytes))
        return {std::move(bytes), false};
    return {latin1_to_utf8(bytes), true};
}

namespace {

constexpr std::string_view white_space = " \t\r\n";
constexpr std::string_view separators = " \t\r\n,";

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    text = trim(text);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty())
        return {};
    // Some exporters write 1e-320 and smaller for 0.
    if (error == std::errc::result_out_of_range && (text.find("e-") != text.npos || text.find("E-") != text.npos))
        return 0.0;
    if (error != std::errc() || !std::isfinite(value))
        return {};
    return value;
}

std::optional<std::vector<float>> parse_numbers(std::string_view text) {
    std::vector<float> numbers;
    while (true) {
        const std::size_t begin = text.find_first_not_of(separators);
        if (begin == std::string_view::npos)
            return numbers;
        text.remove_prefix(begin);
        const std::size_t length = std::min(text.find_first_of(separators), text.size());
        const auto number = parse_number(text.substr(0, length));
        if (!number || !std::isfinite(static_cast<float>(*number)))
            return {};
        numbers.push_back(static_cast<float>(*number));
        text.remove_prefix(length);
    }
}

} // namespace tessera
