#pragma once

#include "recon/metrics/metrics.h"
#include "ui/charts/chart.h"
#include "ui/gl/controls.h"
#include "ui/gl/gl.h"
#include "ui/gl/image_view.h"
#include "ui/state/viewer_state.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

/// Draws the axes, lines and error bars of a plot in the current window, with a marker at the last point of each
/// line.
/// @param colours  one per series
void draw_plot(const ScreenRect& where, const ChartPlot& plot, std::span<const ImU32> colours);

/// Renders the contents of draw_large_charts in the current theme, independently of the window's size: 64 font
/// sizes wide, and as high as the plots need. Callable inside and outside of a Dear ImGui frame, with its OpenGL
/// context current.
ScreenPixels chart_picture(const ViewerState& state);

/// Returns the data of all charts as CSV: three blocks with a header each, separated by an empty line.
/// 1. Errors: pane, from 1; method, norm and alpha of the picture; spp; seconds; relMSE; its standard error, empty
///    if unknown; efficiency; number of skipped non-finite pixels; 1 for an estimate without a reference.
/// 2. Shifts: fraction of each outcome.
/// 3. Histogram of the active pane: luminance at the low end of each bin, and its pixels.
/// Blocks 2 and 3 are omitted if they are empty.
std::string chart_csv(const ViewerState& state);

/// Returns the chosen chart and the active pane's histogram as SVG.
std::string chart_svg(const ViewerState& state);

/// Returns the chosen chart. A chart of errors or efficiencies has one plot. Each pane has a line for each
/// reconstruction that it has used, or one empty line; without a reference, the lines show estimated errors of
/// raw samples. A chart of shifts has a plot for each of panes_with_shifts(), with a line for each of
/// occurred_outcomes().
Chart viewer_chart(const ViewerState& state);

/// Returns the limitations of the errors in the chart: estimates, the reference's own error, skipped pixels.
/// Empty: none.
std::string chart_caveat(const ViewerState& state);

/// Returns the indices of the panes that have shifted paths.
std::vector<std::size_t> panes_with_shifts(const ViewerState& state);

/// Returns "2  G-PR", with the settings that differ from those of other panes: "2  G-PR, tile 6".
std::string pane_name(const ViewerState& state, std::size_t pane);

/// Returns the colours of the series in each plot of viewer_chart.
std::vector<ImU32> line_colours(const ViewerState& state);

/// Returns the outcomes that occurred among the shifts of all panes; empty: there were no shifts.
std::vector<ShiftOutcome> occurred_outcomes(const ViewerState& state);

/// Returns the luminance histogram of the active pane's picture; without series if it is not measured.
ChartPlot histogram_plot(const ViewerState& state);

/// Returns the log-log slope of the last decade of x (log_log_slope). Empty: the points span less than a factor
/// of 3 in x, or their standard errors are unknown.
std::optional<Slope> slope_of_last_decade(const ChartSeries& series);

/// Returns 1 / (relMSE x seconds), 1/s.
double efficiency_of(const ErrorPoint& point);

/// Draws the panel of charts: controls, the chosen chart, and the active pane's histogram. While the large charts
/// are shown, it has the controls only.
void draw_charts_panel(const ScreenRect& where, Controls& controls, ViewerState& state);
/// Draws chart and histogram over the pictures, without controls and as large as `where`. Registers the control
/// rectangle charts.picture.
void draw_large_charts(const ScreenRect& where, Controls& controls, const ViewerState& state);

} // namespace tessera
