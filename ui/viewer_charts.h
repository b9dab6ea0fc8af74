#pragma once

#include "ui/chart.h"
#include "ui/viewer_state.h"

#include <vector>

#include <imgui.h>

namespace tessera {

/// The chart that is chosen. Of errors and efficiencies: one plot with the panes' lines in their order, one for
/// each way in which a pane's pictures were reconstructed, and an empty one where there is none yet; no plot
/// without a reference. Of shifts: a plot for each of the shifting_panes, and in each a line for every outcome
/// that any of them has had.
Chart viewer_chart(const ViewerState& state);

/// What is to be told beside a chart of errors: that the reference's own are in them, how many pixels are left
/// out; empty: nothing.
std::string chart_caveat(const ViewerState& state);

/// Those that have shifted paths.
std::vector<std::size_t> shifting_panes(const ViewerState& state);

/// "2  G-PR".
std::string pane_name(const ViewerState& state, std::size_t pane);

/// Of the lines of each of its plots.
std::vector<ImU32> line_colours(const ViewerState& state);

/// The outcomes that any pane's shifts have had; empty: there were no shifts.
std::vector<ShiftOutcome> seen_outcomes(const ViewerState& state);

/// How many pixels of the active pane's picture have which luminance; without lines where it is not known yet.
ChartPlot histogram_plot(const ViewerState& state);

/// The slope over the last decade of x; not a number while there are too few points (recon/slope.h).
double slope_of_last_decade(const ChartSeries& series);

/// 1 / (relMSE x seconds), 1/s.
double efficiency_of(const ErrorPoint& point);

} // namespace tessera
