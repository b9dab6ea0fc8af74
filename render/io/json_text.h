#pragma once

#include "render/io/text.h"

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// Returns the value as JSON text, on one line or indented by `indent` blanks a level. Invalid UTF-8, as in
/// file names, becomes U+FFFD; the library's dump() would throw.
std::string to_text(const nlohmann::json& value, int indent = -1);
std::string to_text(const nlohmann::ordered_json& value, int indent = -1);

/// Largest nesting depth of objects and arrays that is read. Each level takes stack space of recursive readers.
/// Not tuned.
inline constexpr int max_json_depth = 100;

/// Parses text that Tessera may have written, such as a header's. Null: it is invalid or nested too deep.
nlohmann::json parse_json(std::string_view text);

/// JSON text with positions for error messages.
class JsonText {
public:
    /// `name` is used in messages. Both arguments must outlive this object.
    JsonText(const std::string& text, const std::string& name) : text_(text), name_(name) {}

    const std::string& text() const { return text_; }

    /// Parses the text. Throws LoadError with file, line and column.
    nlohmann::ordered_json parse() const;

    /// Returns the byte offset of the value at a path such as "panes/2/method", or of its innermost existing
    /// ancestor. The text must be valid.
    std::size_t place_of(std::string_view path) const;

    /// Returns the text with everything but the value at `path` blanked, so that offsets stay the same.
    std::string only(std::string_view path) const;

    /// Returns the line and column of place_of(path).
    FilePosition position_of(std::string_view path) const;

    /// Throws LoadError that points at this byte; npos: at the file without a position.
    [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

private:
    FilePosition position_at(std::size_t offset) const;

    const std::string& text_;
    const std::string& name_;
};

} // namespace tessera
