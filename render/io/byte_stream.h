#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tessera {

/// A window into the bytes of a stream, from its current position to its end.
class ByteWindow {
public:
    static constexpr std::size_t capacity = std::size_t{1} << 18;

    explicit ByteWindow(std::istream& stream);

    /// Returns the bytes in memory that were not taken yet.
    std::string_view bytes() const { return bytes_; }
    void take(std::size_t count) { bytes_.remove_prefix(count); }

    /// Loads at least `count` bytes (at most `capacity`). Returns false if the stream ends before.
    bool fill(std::size_t count) { return bytes_.size() >= count || refill(count); }

    /// Returns how many bytes of the stream were not taken yet.
    std::uint64_t left() const { return bytes_.size() + unread_; }

private:
    bool refill(std::size_t count);

    std::istream& stream_;
    std::vector<char> buffer_;
    std::string_view bytes_; // within the buffer
    std::uint64_t unread_;   // bytes that are still in the stream
};

/// Decompresses a zlib stream, from the current position of `compressed`.
class ZlibReader {
public:
    explicit ZlibReader(std::istream& compressed);
    ~ZlibReader();

    /// Reads `size` bytes. Throws std::runtime_error if the stream ends before or is corrupt.
    void read(void* bytes, std::size_t size);

    template <class T>
    T read_value() {
        static_assert(std::is_arithmetic_v<T>);
        T value;
        read(&value, sizeof(T));
        return value;
    }

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tessera
