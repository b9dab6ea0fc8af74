#pragma once

#include "ui/mouse.h"
#include "ui/picture_frame.h"

namespace tessera {

/// Where the mouse is, screen units.
glm::vec2 mouse_position();

/// Where a button of the mouse went down in this frame, or else where the mouse is. In a slow frame it may have
/// come from elsewhere before that, and gone on after.
glm::vec2 grab_position();

/// The mouse over the item just drawn, which is the picture of `frame`.
PaneMouse read_mouse(const PictureFrame& frame);

} // namespace tessera
