#include "ui/chart_file.h"

#include "ui/viewer_charts.h"

#include <cmath>

#include <fmt/core.h>

namespace tessera {

namespace {

/// "weighted,0.2,1", as far as they matter.
std::string reconstruction_columns(const ReconstructionSettings& s) {
    if (s.norm == Norm::none)
        return "none,,";
    return fmt::format("{},{:.6g},{}", to_string(s.norm), s.alpha, static_cast<int>(s.joint_colour));
}

std::string error_lines(const ViewerState& state) {
    std::string text =
        "pane,method,norm,alpha,joint_colour,spp,seconds,relMSE,standard_error,efficiency,not_finite\n";
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        for (const ErrorCurve& curve : state.chart_of(state.panes[i]).curves)
            for (const ErrorPoint& p : curve.points())
                text += fmt::format("{},{},{},{},{:.6g},{:.7g},{},{:.7g},{}\n", i + 1, short_name(curve.method),
                                    reconstruction_columns(curve.reconstruction), p.spp, p.seconds, p.error,
                                    std::isfinite(p.standard_error) ? fmt::format("{:.3g}", p.standard_error) : "",
                                    efficiency_of(p), p.not_finite);
    return text;
}

std::string shift_lines(const ViewerState& state) {
    std::string header = "\npane,method,spp,seconds", text;
    for (int i = 0; i < shift_outcome_count; ++i)
        header += fmt::format(",{}", to_string(static_cast<ShiftOutcome>(i)));
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        for (const ShiftPoint& p : state.chart_of(state.panes[i]).shifts.points()) {
            text += fmt::format("{},{},{},{:.6g}", i + 1, short_name(p.method), p.spp, p.seconds);
            for (double share : p.shares)
                text += fmt::format(",{:.6g}", share);
            text += '\n';
        }
    }
    return text.empty() ? "" : header + "\n" + text;
}

std::string histogram_lines(const ViewerState& state) {
    const auto& histogram = state.chart_of(state.active()).histogram;
    if (!histogram)
        return "";
    std::string text = "\nluminance,pixels\n";
    for (int bin = 0; bin < Histogram::bin_count; ++bin)
        text +=
            fmt::format("{:.6g},{}\n", Histogram::low_end(bin), histogram->bins[static_cast<std::size_t>(bin)]);
    return text;
}

} // namespace

std::string chart_csv(const ViewerState& state) {
    return error_lines(state) + shift_lines(state) + histogram_lines(state);
}

std::string chart_svg(const ViewerState& state) {
    Chart chart = viewer_chart(state);
    for (ChartPlot& plot : chart.plots) {
        for (ChartSeries& series : plot.series) {
            const double slope = slope_of_last_decade(series);
            if (state.chart_kind == ChartKind::error && std::isfinite(slope))
                series.label += fmt::format(" (slope {:.2f})", slope);
        }
    }
    if (ChartPlot histogram = histogram_plot(state); !histogram.series.empty())
        chart.plots.push_back(std::move(histogram));
    return to_svg(chart);
}

} // namespace tessera
