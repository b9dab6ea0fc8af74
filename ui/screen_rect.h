#pragma once

#include <glm/vec2.hpp>

namespace tessera {

/// Part of the screen, in screen units.
struct ScreenRect {
    glm::vec2 min{0};
    glm::vec2 max{0};
    glm::vec2 size() const { return max - min; }
    bool contains(glm::vec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
};

} // namespace tessera
