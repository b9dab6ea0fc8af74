#pragma once

#include <stdexcept>
#include <string>
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
};

/// Loading failed. what() is complete: "file:line:column: what is wrong", then the line itself with a caret.
class LoadError : public std::runtime_error {
public:
    LoadError(const FilePosition& where, const std::string& text, const std::string& source_line = {});
};

} // namespace tessera
