#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tessera {

/// The bytes of a stream from where it stands, a part of them in memory at a time.
class ByteWindow {
public:
    static constexpr std::size_t capacity = std::size_t{1} << 18;

    explicit ByteWindow(std::istream& stream);

    /// The bytes in memory that were not taken yet.
    std::string_view bytes() const { return bytes_; }
    void take(std::size_t count) { bytes_.remove_prefix(count); }

    /// Brings at least `count` bytes into memory (no more than `capacity`); false when the stream ends before.
    bool fill(std::size_t count) { return bytes_.size() >= count || refill(count); }

    /// How many bytes were not taken yet, in memory or not.
    std::uint64_t left() const { return bytes_.size() + unread_; }

private:
    bool refill(std::size_t count);

    std::istream& stream_;
    std::vector<char> buffer_;
    std::string_view bytes_; // part of the buffer
    std::uint64_t unread_;   // bytes in the stream
};

/// The bytes that a zlib stream holds, from where `compressed` stands.
class ZlibReader {
public:
    explicit ZlibReader(std::istream& compressed);
    ~ZlibReader();

    /// Fills `size` bytes. Throws std::runtime_error when there are not as many, or the stream is broken.
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
