#pragma once

#include "render/io/byte_stream.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Returns the size of a value in the binary formats, in bytes.
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32; ///< of the value, or of a list's items
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; ///< bytes before the first value
};

/// Parses the header at the beginning of the bytes. Throws std::runtime_error with the line number.
PlyHeader parse_ply_header(std::string_view bytes);

/// Reads the values after the header of a PLY file, as text or as binary of either byte order.
class PlyValues {
public:
    PlyValues(ByteWindow& bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    bool is_text() const { return format_ == PlyFormat::ascii; }
    /// Returns how many bytes are left.
    std::uint64_t left() const { return bytes_.left(); }

    /// Takes one value. Throws std::runtime_error at the end, or if the text is not a number.
    double next(PlyType type);

private:
    template <class T>
    T next_binary();
    double next_word();
    void skip_white_space();

    ByteWindow& bytes_;
    PlyFormat format_;
};

} // namespace tessera
