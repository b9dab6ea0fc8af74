#pragma once

#include <cstddef>
#include <string>

namespace tessera {

/// A file within the program (cmake/embed.cmake).
struct EmbeddedFile {
    const char* name; ///< its path in the folder that was embedded
    const unsigned char* bytes;
    std::size_t size;

    std::string text() const { return {reinterpret_cast<const char*>(bytes), size}; }
};

} // namespace tessera
