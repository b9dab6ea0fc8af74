#pragma once

#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// The points of the panes' error charts, a line each: pane (from 1), method, norm, spp, seconds, relMSE; then an
/// empty line and the bins of the active pane's histogram. Without any, the header alone.
std::string chart_csv(const ViewerState& state);

} // namespace tessera
