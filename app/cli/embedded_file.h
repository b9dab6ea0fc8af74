#pragma once

#include <cstddef>
#include <string>

namespace tessera {

/// A file embedded into the program (cmake/embed.cmake).
struct EmbeddedFile {
    const char* name; ///< path within the embedded folder
    const unsigned char* bytes;
    std::size_t size;

    std::string text() const { return {reinterpret_cast<const char*>(bytes), size}; }
};

} // namespace tessera
