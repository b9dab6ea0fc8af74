#pragma once

#include "ui/picture_frame.h"
#include "ui/showing.h"

#include <string>

namespace tessera {

/// With as many of three digits as seven characters have room for: "0.0123", "-1e-05".
std::string short_number(float value);

/// Writes the value of each pixel into it, in the unit that the status line shows, where pixels are large enough
/// to read it. Tells whether they are.
bool draw_pixel_numbers(const PictureFrame& frame, int pane, const ViewerState& state, const PaneImages& images);

} // namespace tessera
