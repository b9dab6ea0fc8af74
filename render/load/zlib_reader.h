#pragma once

#include <istream>
#include <memory>
#include <type_traits>

namespace tessera {

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
