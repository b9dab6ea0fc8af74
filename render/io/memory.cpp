#include "render/io/memory.h"

#include <zlib.h>

namespace tessera {

std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t before) {
    if (bytes.empty())
        return before; // zlib takes a null pointer for a new beginning
    return static_cast<std::uint32_t>(
        crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

} // namespace tessera
