#pragma once

#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// All that charts show, in blocks with a header each and an empty line between them: the panes' errors (pane from
/// 1, method, norm, spp, seconds, relMSE, efficiency), the shares of their shifts by outcome, and the bins of the
/// active pane's histogram. Blocks without lines are left out, but for the first.
std::string chart_csv(const ViewerState& state);

/// The chart that is chosen, and the active pane's histogram.
std::string chart_svg(const ViewerState& state);

} // namespace tessera
