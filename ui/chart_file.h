#pragma once

#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// All that charts show, in blocks with a header each and an empty line between them: the panes' errors (pane from
/// 1; method, norm, alpha and joint colour that the picture was made with; spp, seconds, relMSE and its standard
/// error, empty where the reference has no halves; efficiency; pixels left out as they are not finite), the shares
/// of their shifts by outcome, and the bins of the active pane's histogram. Blocks without lines are left out, but
/// for the first.
std::string chart_csv(const ViewerState& state);

/// The chart that is chosen, and the active pane's histogram.
std::string chart_svg(const ViewerState& state);

} // namespace tessera
