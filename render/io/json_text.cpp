#include "render/io/json_text.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// Strips the library's prefix and suffix from its message: "[json.exception.parse_error.101] parse error at
/// line 1, column 2: syntax error while parsing value - invalid literal; last read: 'x'".
std::string bare_message(std::string what) {
    if (const std::size_t dash = what.find(" - "); dash != std::string::npos)
        what.erase(0, dash + 3);
    return what.substr(0, what.find("; last read")); // the caret shows what was read
}

/// Walks over a valid JSON text, because the library does not provide the offsets of values.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::size_t skip_space(std::size_t at) const {
        return std::min(text_.find_first_not_of(" \t\r\n", at), text_.size());
    }

    /// Returns the offset after the value that begins at `at`.
    std::size_t skip_value(std::size_t at) const {
        if (text_[at] == '"')
            return skip_string(at);
        if (text_[at] != '{' && text_[at] != '[')
            return std::min(text_.find_first_of(",]} \t\r\n", at), text_.size());
        int depth = 0;
        while (at < text_.size()) {
            const char c = text_[at];
            depth += c == '{' || c == '[';
            depth -= c == '}' || c == ']';
            at = c == '"' ? skip_string(at) : at + 1;
            if (depth == 0)
                break;
        }
        return at;
    }

    /// Returns the offset of the named member or indexed element in the value that begins at `at`; npos: there
    /// is none.
    std::size_t find(std::size_t at, std::string_view name) const {
        const bool is_object = text_[at] == '{';
        if (!is_object && text_[at] != '[')
            return std::string_view::npos;
        at = skip_space(at + 1);
        for (int index = 0; at < text_.size() && text_[at] != '}' && text_[at] != ']'; ++index) {
            std::string key = std::to_string(index);
            if (is_object) {
                const std::size_t end = skip_string(at);
                key = text_.substr(at + 1, end - at - 2);
                at = skip_space(skip_space(end) + 1); // the colon
            }
            if (key == name)
                return at;
            at = skip_space(skip_value(at));
            if (at < text_.size() && text_[at] == ',')
                at = skip_space(at + 1);
        }
        return std::string_view::npos;
    }

private:
    std::size_t skip_string(std::size_t at) const {
        for (++at; at < text_.size() && text_[at] != '"'; ++at)
            at += text_[at] == '\\';
        return std::min(at + 1, text_.size());
    }

    std::string_view text_;
};

/// Returns the offset at which a text, JSON or not, exceeds max_json_depth; npos: nowhere.
std::size_t too_deep(std::string_view text) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"')
            in_string = !in_string;
        else if (in_string)
            at += c == '\\';
        else if ((c == '{' || c == '[') && ++depth > max_json_depth)
            return at;
        else if (c == '}' || c == ']')
            --depth;
    }
    return std::string_view::npos;
}

std::string deep_message() {
    return fmt::format("objects and arrays are nested more than {} deep", max_json_depth);
}

std::size_t line_begin(const std::string& text, std::size_t offset) {
    const std::size_t before = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
    return before == std::string::npos ? 0 : before + 1;
}

} // namespace

std::string to_text(const nlohmann::json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string to_text(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::json parse_json(std::string_view text) {
    if (too_deep(text) != std::string_view::npos)
        return nullptr;
    nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    return value.is_discarded() ? nlohmann::json() : value;
}

nlohmann::ordered_json JsonText::parse() const {
    if (text_.empty())
        fail_at(0, "the file is empty");
    if (const std::size_t at = too_deep(text_); at != std::string::npos)
        fail_at(at, deep_message());
    try {
        return nlohmann::ordered_json::parse(text_);
    } catch (const nlohmann::json::parse_error& e) {
        fail_at(e.byte > 0 ? e.byte - 1 : 0, "the JSON is broken: " + bare_message(e.what()));
    } catch (const nlohmann::json::exception& e) { // an overflowing number, quoted in the message
        const std::string what = e.what();
        const std::size_t open = what.find('\''), close = what.rfind('\'');
        const std::string number = open < close ? what.substr(open + 1, close - open - 1) : "";
        fail_at(text_.find(number), "the number " + number + " is too large");
    }
}

std::size_t JsonText::place_of(std::string_view path) const {
    const Scanner scanner(text_);
    std::size_t at = scanner.skip_space(0);
    while (!path.empty()) {
        const std::size_t slash = std::min(path.find('/'), path.size());
        const std::size_t next = scanner.find(at, path.substr(0, slash));
        if (next == std::string_view::npos)
            break;
        at = next;
        path.remove_prefix(std::min(slash + 1, path.size()));
    }
    return at;
}

FilePosition JsonText::position_of(std::string_view path) const {
    return position_at(place_of(path));
}

FilePosition JsonText::position_at(std::size_t offset) const {
    const auto at = text_.begin() + static_cast<std::ptrdiff_t>(offset);
    const int line = 1 + static_cast<int>(std::count(text_.begin(), at, '\n'));
    return {name_, line, 1 + static_cast<int>(offset - line_begin(text_, offset))};
}

std::string JsonText::only(std::string_view path) const {
    const std::size_t begin = place_of(path), end = Scanner(text_).skip_value(begin);
    std::string text = text_;
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((i < begin || i >= end) && text[i] != '\n')
            text[i] = ' ';
    return text;
}

void JsonText::fail_at(std::size_t offset, const std::string& message) const {
    if (offset == std::string::npos)
        throw LoadError({name_, 0, 0}, message);
    offset = std::min(offset, text_.size());
    const std::size_t begin = line_begin(text_, offset), end = std::min(text_.find('\n', begin), text_.size());
    throw LoadError(position_at(offset), message, text_.substr(begin, end - begin));
}

} // namespace tessera
