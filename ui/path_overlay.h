#pragma once

#include "ui/path_drawing.h"
#include "ui/viewer_state.h"

namespace tessera {

/// Those of the shifts of an inspection that are shown.
std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector);

/// Whether a pane still shows the request of that generation.
bool is_on_show(std::uint64_t generation, const ViewerState& state);

/// Draws the inspected sample over the picture of its pane: the base path in white, light samples in yellow, and
/// the shifts that are shown, in the colours of their outcomes, as the pixels that they come from or go to are;
/// the sampling set has a line around it, its border another. In other panes the pixel alone is marked. To be
/// called within the pane's window.
void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

} // namespace tessera
