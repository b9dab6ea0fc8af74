#pragma once

#include "ui/screenshot.h"
#include "ui/showing.h"

namespace tessera {

/// What a pane shows, one pixel for each of the image's, in the colours that are on show; of a wipe, the pane's
/// own picture. Empty: there is none, or only a first look.
ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state);

} // namespace tessera
