#include "render/load/messages.h"

#include <algorithm>

namespace tessera {

namespace {

// A line may hold a matrix, or a whole file: what is shown stays on one line of a terminal.
constexpr std::size_t shown_length = 150;

/// How many columns of a terminal the text takes: bytes of UTF-8 without the continuation bytes.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

std::string with_caret(const std::string& source_line, int column) {
    std::string line = source_line;
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    if (column < 1)
        return "\n    " + line.substr(0, shown_length);
    std::size_t at = std::min(static_cast<std::size_t>(column - 1), line.size());
    std::string prefix;
    if (at > shown_length * 2 / 3) {
        const std::size_t cut = at - shown_length / 2;
        line.erase(0, cut);
        at -= cut;
        prefix = "...";
    }
    const std::size_t caret = prefix.size() + width_of(line.substr(0, at));
    return "\n    " + prefix + line.substr(0, shown_length) + "\n    " + std::string(caret, ' ') + "^";
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

} // namespace tessera
