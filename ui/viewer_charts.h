#pragma once

#include "ui/chart.h"
#include "ui/viewer_state.h"

#include <vector>

#include <imgui.h>

namespace tessera {

/// The chart that is chosen. Of errors and efficiencies: one plot with a line a pane, in their order, empty ones
/// among them; no plot without a reference. Of shifts: a plot for each of the shifting_panes, and in each a line
/// for every outcome that any of them has had.
Chart viewer_chart(const ViewerState& state);

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
