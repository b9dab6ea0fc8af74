#pragma once

#include <optional>

#include <glm/vec2.hpp>

namespace tessera {

/// Where a window is on the desktop, in screen units.
struct WindowPlace {
    glm::ivec2 size{0};                 ///< of its contents while it is not maximised; 0: not known
    std::optional<glm::ivec2> position; ///< likewise, of their upper left corner; empty: not known
    bool maximised = false;

    bool operator==(const WindowPlace&) const = default;
};

} // namespace tessera
