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
                         (source_line.empty() ? std::string() : with_caret(source_line, where.column))) {}

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
