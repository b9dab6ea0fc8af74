#pragma once

#include "ui/picture_frame.h"
#include "ui/viewer_state.h"

#include <imgui.h>

namespace tessera {

/// The colour that stands for how a shift ended.
ImU32 outcome_colour(ShiftOutcome outcome);

/// Those of the shifts of an inspection that are shown.
std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector);

/// Draws the inspected sample over the picture of its pane: the base path in white, light samples in yellow, and
/// the shifts that are shown, in the colours of their outcomes. In other panes the pixel alone is marked. To be
/// called within the pane's window.
void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state);

} // namespace tessera
