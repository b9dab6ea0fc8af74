#pragma once

#include "render/io/text.h"

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// The value as text, on one line, or with `indent` blanks a level. What is not UTF-8, as names of files may be,
/// becomes U+FFFD: the library's own dump() throws.
std::string to_text(const nlohmann::json& value, int indent = -1);
std::string to_text(const nlohmann::ordered_json& value, int indent = -1);

/// How many objects and arrays may lie in each other in what is read: more means nothing to us, and each takes a
/// piece of the stack of whoever goes through them.
inline constexpr int deepest_json = 100;

/// What a text says that we may have written ourselves, such as a header's. Null: it is none of ours, as it is no
/// JSON, or nested too deep.
nlohmann::json parse_json(std::string_view text);

/// A text of JSON, for messages that point into it.
class JsonText {
public:
    /// `name` stands in messages. Both must live as long as this.
    JsonText(const std::string& text, const std::string& name) : text_(text), name_(name) {}

    const std::string& text() const { return text_; }

    /// What it says. Throws LoadError with file, line and column.
    nlohmann::ordered_json parse() const;

    /// Where the value of a path such as "panes/2/method" begins, or the innermost one around it that is there;
    /// bytes from the beginning. The text must be valid.
    std::size_t place_of(std::string_view path) const;

    /// The value at a path alone, all else made blank: places in it are those in the whole.
    std::string only(std::string_view path) const;

    /// The line and column of place_of(path).
    FilePosition position_of(std::string_view path) const;

    /// Throws LoadError that points at this byte; npos: at no place in the text.
    [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;

private:
    FilePosition position_at(std::size_t offset) const;

    const std::string& text_;
    const std::string& name_;
};

} // namespace tessera
