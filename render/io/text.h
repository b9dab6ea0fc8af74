// Text of files: positions, notes and errors, encoding, and numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A position in a file. Line and column count from 1; 0: unknown.
struct FilePosition {
    std::string file;
    int line = 0;
    int column = 0;

    /// Returns "file:line:column", without unknown parts.
    std::string to_string() const;
};

/// A note that the loader ignored, approximated or replaced something.
struct LoadNote {
    FilePosition where;
    std::string text;
    bool is_error = false; ///< something needed is missing, so that the image is wrong
};

/// Thrown if loading fails. what() is "file:line:column: message", then the source line with a caret.
class LoadError : public std::runtime_error {
public:
    LoadError(const FilePosition& where, const std::string& text, const std::string& source_line = {});

    /// Returns an error note about what is used in place of the thing that cannot be read, as `consequence` says.
    LoadNote note(const std::string& consequence) const { return {where_, text_ + "; " + consequence, true}; }

private:
    FilePosition where_;
    std::string text_;
};

/// Reads a scene file's bytes. Throws LoadError.
std::string read_text(const std::filesystem::path& file);

/// A text in UTF-8 without byte order mark, and whether it was converted from Latin-1, as which invalid UTF-8
/// is read. UTF-16 is recognised by its byte order mark, or by the zero byte of a leading "<". to_utf8() throws
/// std::runtime_error for invalid UTF-16 and for NUL bytes.
struct Utf8Text {
    std::string text;
    bool was_latin1 = false;
};
Utf8Text to_utf8(std::string bytes);

/// Returns the text with ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// Parses the whole text as a finite number, independent of the locale; spaces around it are allowed. Empty:
/// invalid.
std::optional<double> parse_number(std::string_view text);

/// Parses numbers separated by commas or white space, each finite as a float. Empty: one is invalid.
std::optional<std::vector<float>> parse_numbers(std::string_view text);

} // namespace tessera
