#pragma once

#include "ui/viewer_state.h"

namespace tessera {

/// The mouse over one pane's picture in one frame; positions in pixels of the pane from its top left.
struct PaneMouse {
    glm::vec2 position{0};
    glm::vec2 previous{0}; ///< in the frame before
    float wheel = 0;       ///< notches, up is positive
    bool left = false;     ///< held, having gone down over this pane
    bool middle = false;
    bool right = false;
    bool ctrl = false;
    bool shift = false;
};

/// Moves the camera or the picture. `placement` is where the picture of `image_size` pixels lies in the pane.
void apply_mouse(const PaneMouse& mouse, const Placement& placement, glm::ivec2 image_size, glm::ivec2 pane_size,
                 ViewerState& state);

} // namespace tessera
