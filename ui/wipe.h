#pragma once

#include "ui/controls.h"
#include "ui/picture_frame.h"
#include "ui/showing.h"

namespace tessera {

/// The line that divides two pictures in a pane, and the names of what a comparison shows.

/// Whether a point of the screen is near enough to the line to take hold of it.
bool is_on_wipe(const PictureFrame& frame, float wipe, glm::vec2 point);

/// Draws the line with its handle and a label at each side; without a line, one label in the middle. `id` of the
/// pane. To be called after the item that the picture is.
void draw_comparison(const PictureFrame& frame, const std::string& id, int pane, const ViewerState& state,
                     Controls& controls);

} // namespace tessera
