#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// 8-bit RGB, row by row from the top left.
struct ScreenPixels {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;

    const std::uint8_t* at(int x, int y) const {
        return rgb.data() +
               3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x));
    }
};

/// What was drawn into the framebuffer bound for reading, from its lower left corner.
ScreenPixels read_screen(glm::ivec2 size);

} // namespace tessera
