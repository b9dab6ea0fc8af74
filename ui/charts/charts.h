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

/// Draws the axes and lines of a plot in the current window, the last point of each line marked. Error bars,
/// levels and names are the files' alone: the viewer measures none. `colours`: one for each series.
void draw_plot(const ScreenRect& where, const ChartPlot& plot, std::span<const ImU32> colours);

/// What draw_large_charts (panels.h) shows, in the look on show but of a size of its own, which no window limits:
/// 64 sizes of the font wide, and as high as its plots want. Within a frame of Dear ImGui or between two, its
/// OpenGL context current.
ScreenPixels chart_picture(const ViewerState& state);

/// All that charts show, in blocks with a header each and an empty line between them: the panes' errors (pane from
/// 1; method, norm and alpha that the picture was made with; spp, seconds, relMSE and its standard
/// error, empty where the reference has no halves; efficiency; pixels left out as they are not finite; 1 where it
/// is an estimate of the samples' error, without a reference), the shares of their shifts by outcome, and the bins
/// of the active pane's histogram. Blocks without lines are left out, but for the first.
std::string chart_csv(const ViewerState& state);

/// The chart that is chosen and the active pane's histogram, as a picture of SVG.
std::string chart_svg(const ViewerState& state);

/// The chart that is chosen. Of errors and efficiencies: one plot with the panes' lines in their order, one for
/// each way in which a pane's pictures were reconstructed, and an empty one where there is none yet; without a
/// reference, of the samples' estimated errors. Of shifts: a plot for each of the shifting_panes, and in each a
/// line for every outcome that any of them has had.
Chart viewer_chart(const ViewerState& state);

/// What is to be told beside a chart of errors: that they are estimates, that the reference's own are in them, how
/// many pixels are left out; empty: nothing.
std::string chart_caveat(const ViewerState& state);

/// The panes, by place, whose pictures have shifted paths.
std::vector<std::size_t> shifting_panes(const ViewerState& state);

/// "2  G-PR", or with what tells it from other panes: "2  G-PR, tile 6".
std::string pane_name(const ViewerState& state, std::size_t pane);

/// The colours of the lines in each plot of viewer_chart, in their order.
std::vector<ImU32> line_colours(const ViewerState& state);

/// The outcomes that any pane's shifts have had; empty: there were no shifts.
std::vector<ShiftOutcome> seen_outcomes(const ViewerState& state);

/// How many pixels of the active pane's picture have which luminance; without lines where it is not known yet.
ChartPlot histogram_plot(const ViewerState& state);

/// Over the last decade of x (recon/metrics/metrics.h). Empty: there are too few points for it, or their own
/// errors are not known.
std::optional<Slope> slope_of_last_decade(const ChartSeries& series);

/// 1 / (relMSE x seconds), 1/s.
double efficiency_of(const ErrorPoint& point);

/// Draws errors, efficiencies or shifts against time or samples, and the active pane's histogram; only what is to
/// be shown, while they are drawn large.
void draw_charts_panel(const ScreenRect& where, Controls& controls, ViewerState& state);
/// Draws chart and histogram without the controls, as large as there is room; over the pictures. Noted as
/// charts.picture.
void draw_large_charts(const ScreenRect& where, Controls& controls, const ViewerState& state);

} // namespace tessera
