// The text of files: places in it, what is said of them, its encoding, and numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A place in a file. Line and column count from 1; 0: unknown.
struct FilePosition {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", shorter where a part is unknown.
    std::string to_string() const;
};

/// What the loader did not take as it stands: ignored, approximated, replaced.
struct LoadNote {
    FilePosition where;
    std::string text;
    bool is_error = false; ///< something that the scene needs is missing: its picture is not what was meant
};

/// Loading failed. what() is complete: "file:line:column: what is wrong", then the line itself with a caret.
class LoadError : public std::runtime_error {
public:
    LoadError(const FilePosition& where, const std::string& text, const std::string& source_line = {});
};

/// A scene file's bytes; throws LoadError.
std::string read_text(const std::filesystem::path& file);

/// The text in UTF-8 without a byte order mark, and whether it had to be converted for that: bytes that are no
/// UTF-8 are taken for Latin-1. Throws std::runtime_error for UTF-16 and for NUL bytes.
struct Utf8Text {
    std::string text;
    bool was_latin1 = false;
};
Utf8Text to_utf8(std::string bytes);

/// The text with small letters for large ones, of ASCII.
std::string lower_case(std::string_view text);

/// The whole text as a finite number, whatever the locale; spaces around it are allowed. Empty: it is none.
std::optional<double> parse_number(std::string_view text);

/// Numbers separated by commas or white space, each finite as a float. Empty: one of them is none.
std::optional<std::vector<float>> parse_numbers(std::string_view text);

} // namespace tessera
