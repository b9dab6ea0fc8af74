#pragma once

#include "ui/controls.h"
#include "ui/showing.h"
#include "ui/viewer_state.h"

namespace tessera {

/// What pane views draw with.
struct PaneTools {
    const CanvasShader& shader;
    const PaneImages& images;
    Controls& controls;
    ViewerState& state;
};

} // namespace tessera
