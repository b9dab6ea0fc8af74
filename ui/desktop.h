#pragma once

#include <glm/vec2.hpp>

namespace tessera {

/// The size, as far as the first screen has room for it; >= 1x1.
glm::ivec2 on_screen(glm::ivec2 size);

/// Whether a window with this corner can be got hold of: its screen may have been taken away.
bool is_on_a_screen(glm::ivec2 corner);

} // namespace tessera
