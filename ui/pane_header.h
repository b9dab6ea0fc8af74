#pragma once

#include "ui/controls.h"
#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// The strip above a pane's picture: method and buffer.
void draw_pane_header(const std::string& id, Controls& controls, PaneState& pane);

} // namespace tessera
