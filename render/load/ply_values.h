#pragma once

#include "render/load/byte_window.h"
#include "render/load/ply_header.h"

#include <cstdint>

namespace tessera {

/// The values after the header of a PLY file, one after another, as text or as bytes of either order.
class PlyValues {
public:
    PlyValues(ByteWindow& bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    bool is_text() const { return format_ == PlyFormat::ascii; }
    /// Bytes to come.
    std::uint64_t left() const { return bytes_.left(); }

    /// Throws std::runtime_error when there is none, or what is there is no number.
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
