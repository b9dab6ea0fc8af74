#pragma once

#include "render/io/byte_stream.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// How many bytes a value has in the binary formats.
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
    std::size_t size = 0; ///< bytes, up to the first value
};

/// Reads the header at the beginning of the bytes. Throws std::runtime_error with the line.
PlyHeader parse_ply_header(std::string_view bytes);

/// The values after the header of a PLY file, one after another, as text or as bytes of either order.
class PlyValues {
public:
    PlyValues(ByteWindow& bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    bool is_text() const { return format_ == PlyFormat::ascii; }
    /// How many bytes are still to come.
    std::uint64_t left() const { return bytes_.left(); }

    /// Takes one value. Throws std::runtime_error when there is none, or what is there is no number.
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
