#pragma once

#include <filesystem>
#include <string>

namespace tessera {

/// A scene file's bytes; throws LoadError.
std::string read_text(const std::filesystem::path& file);

/// The text in UTF-8 without a byte order mark, and whether it had to be converted for that: bytes that are no
/// UTF-8 are taken for Latin-1. Throws std::runtime_error for UTF-16 and for NUL bytes.
struct Utf8Text {
    std::string text;
    bool was_latin1 = false;
};
Utf8Text to_utf8(std::string bytes);

} // namespace tessera
