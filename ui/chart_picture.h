#pragma once

#include "ui/screenshot.h"
#include "ui/viewer_state.h"

namespace tessera {

/// What draw_large_charts (panels.h) shows, in the look on show but of a size of its own, which no window limits:
/// 64 sizes of the font wide, and as high as its plots want. Within a frame of Dear ImGui or between two, its
/// OpenGL context current.
ScreenPixels chart_picture(const ViewerState& state);

} // namespace tessera
