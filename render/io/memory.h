#pragma once

#include "recon/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tessera {

/// The memory that holds the state of something, piece by piece: what a checkpoint keeps, and fills again.
using Memory = std::vector<std::span<std::byte>>;

/// The memory of one number or plain struct.
template <class T>
std::span<std::byte> memory_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_writable_bytes(std::span(&value, 1));
}

/// The memory of an image's pixels.
template <class Pixel>
std::span<std::byte> memory_of(Image<Pixel>& image) {
    static_assert(std::is_trivially_copyable_v<Pixel>);
    return std::as_writable_bytes(std::span(image.data(), image.size()));
}

/// Adds the pieces of `more`.
inline void append(Memory& memory, const Memory& more) {
    memory.insert(memory.end(), more.begin(), more.end());
}

/// The CRC-32 of the bytes, which goes on from `before`, that of the bytes before them.
std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t before = 0);

} // namespace tessera
