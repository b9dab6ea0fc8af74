#pragma once

#include "ui/picture_frame.h"
#include "ui/viewer_state.h"

namespace tessera {

/// Whether the slow motion has a tile to show.
bool has_slow_motion(const ViewerState& state);
/// Whether it is this pane's.
bool shows_slow_motion(int pane, const ViewerState& state);

/// Draws the tile over the picture of its pane: its parts, the sampling set at hand with its border, what every
/// pixel has got so far, and arrows from the base path that arrives to the pixels that it is shifted to, in the
/// colours of their outcomes. To be called within the pane's window.
void draw_slow_motion(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

} // namespace tessera
