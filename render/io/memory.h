#pragma once

#include "recon/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tessera {

/// The memory of an object's state, in pieces. A checkpoint saves and restores it.
using Memory = std::vector<std::span<std::byte>>;

/// Returns the memory of one number or plain struct.
template <class T>
std::span<std::byte> memory_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_writable_bytes(std::span(&value, 1));
}

/// Returns the memory of an image's pixels.
template <class Pixel>
std::span<std::byte> memory_of(Image<Pixel>& image) {
    static_assert(std::is_trivially_copyable_v<Pixel>);
    return std::as_writable_bytes(std::span(image.data(), image.size()));
}

/// Appends the pieces of `more`.
inline void append(Memory& memory, const Memory& more) {
    memory.insert(memory.end(), more.begin(), more.end());
}

/// Returns the CRC-32 of the bytes, continued from `before`, the checksum of the preceding bytes.
std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t before = 0);

} // namespace tessera
