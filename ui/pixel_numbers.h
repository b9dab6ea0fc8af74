#pragma once

#include "ui/picture_frame.h"
#include "ui/showing.h"

namespace tessera {

/// Writes the value of each pixel into it, where pixels are large enough to read it. Tells whether they are.
bool draw_pixel_numbers(const PictureFrame& frame, int pane, const ViewerState& state, const PaneImages& images);

} // namespace tessera
