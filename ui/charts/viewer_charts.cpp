#include "recon/metrics/metrics.h"
#include "ui/charts/charts.h"
#include "ui/gl/tone.h"
#include "ui/state/companions.h"
#include "ui/state/inspected.h"
#include "ui/state/pane_labels.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

using Scale = ChartAxis::Scale;

Method method_of(const ViewerState& state, std::size_t pane) {
    return state.panes[pane].settings.render.method;
}

std::string method_name(std::size_t pane, Method method) {
    return fmt::format("{}  {}", pane + 1, paper_name(method));
}

const PassHistory<ShiftPoint>& shifts_of(const ViewerState& state, std::size_t pane) {
    return state.charts.of(state.panes[pane]).shifts;
}

template <class Point>
double x_of(const ViewerState& state, const Point& p) {
    return state.layout.charts_by_spp ? p.spp : p.seconds;
}

ChartPlot empty_plot(const ViewerState& state, std::string y_label, Scale y_scale) {
    return {state.layout.charts_by_spp ? "samples a pixel" : "seconds",
            std::move(y_label),
            Scale::log,
            y_scale,
            {},
            {}};
}

/// Returns the pane's curves. Empty if they are for another reference than the current one.
const std::vector<ErrorCurve>& curves_of(const ViewerState& state, std::size_t pane) {
    static const std::vector<ErrorCurve> none;
    const PaneChart& chart = state.charts.of(state.panes[pane]);
    return chart.reference == state.companions.reference ? chart.curves : none;
}

/// A line of the chart of errors.
struct PaneLine {
    std::size_t pane;
    const ErrorCurve* curve; // null: the pane has none yet
    std::string name;
    std::size_t age; // number of newer lines of the pane
};

/// Returns the settings that made the pictures of a line.
PaneSettings settings_of(const ViewerState& state, const PaneLine& line) {
    PaneSettings settings = state.panes[line.pane].settings;
    if (line.curve) {
        settings.render.method = line.curve->method;
        settings.reconstruction = line.curve->reconstruction;
    }
    if (!state.companions.reference)
        settings.reconstruction = {}; // estimates are for raw samples
    return settings;
}

std::vector<PaneLine> error_lines(const ViewerState& state) {
    std::vector<PaneLine> lines;
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        const std::vector<ErrorCurve>& curves = curves_of(state, i);
        for (std::size_t c = 0; c < curves.size(); ++c)
            lines.push_back({i, &curves[c], "", curves.size() - 1 - c});
        if (curves.empty())
            lines.push_back({i, nullptr, "", 0});
    }
    std::vector<PaneSettings> all;
    for (const PaneLine& line : lines)
        all.push_back(settings_of(state, line));
    for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i].name = fmt::format("{}  {}{}", lines[i].pane + 1, picture_label(all[i], all),
                                    state.companions.reference ? "" : ", samples");
    return lines;
}

/// Returns a style with dashes by norm. The marker distinguishes panes with the same method.
LineStyle look_of(const ViewerState& state, const PaneLine& line) {
    const PaneSettings settings = settings_of(state, line);
    int marker = 0;
    for (std::size_t i = 0; i < line.pane; ++i)
        marker += method_of(state, i) == method_of(state, line.pane);
    return {settings.render.method, settings.reconstruction.norm, marker};
}

/// Returns the standard error of the error, or of the efficiency. Not a number: unknown.
double standard_error(const ErrorPoint& p, bool is_error) {
    return is_error ? p.standard_error : efficiency_of(p) * p.standard_error / p.error;
}

ChartPlot error_plot(const ViewerState& state) {
    const bool is_error = state.layout.chart_kind == ChartKind::error;
    const std::string suffix = state.companions.reference ? "" : ", estimated";
    ChartPlot plot = empty_plot(state, (is_error ? "relMSE" : "1 / (relMSE x seconds)") + suffix, Scale::log);
    for (const PaneLine& line : error_lines(state)) {
        ChartSeries series{line.name, {}, false, true, look_of(state, line)};
        if (line.curve)
            for (const ErrorPoint& p : line.curve->points())
                series.points.push_back(
                    {x_of(state, p), is_error ? p.error : efficiency_of(p), standard_error(p, is_error)});
        plot.series.push_back(std::move(series));
    }
    return plot;
}

ChartPlot shift_plot(const ViewerState& state, std::size_t pane) {
    const std::vector<ShiftPoint>& points = shifts_of(state, pane).points();
    const std::string name = method_name(pane, points.back().method);
    ChartPlot plot = empty_plot(state, name + "  % of shifts", Scale::log);
    for (ShiftOutcome outcome : occurred_outcomes(state)) {
        ChartSeries series{label_of_identifier(to_string(outcome)), {}, false, true};
        for (const ShiftPoint& p : points)
            series.points.push_back({x_of(state, p), 100 * p.shares[static_cast<std::size_t>(outcome)], 0});
        plot.series.push_back(std::move(series));
    }
    return plot;
}

/// Returns the colour of an outcome, darker in the light theme so that text in it is readable.
ImU32 readable(ImU32 colour, Theme theme) {
    ImVec4 c = ImGui::ColorConvertU32ToFloat4(colour);
    const float brightness = theme == Theme::light ? 0.72f : 1.0f;
    return ImGui::ColorConvertFloat4ToU32({c.x * brightness, c.y * brightness, c.z * brightness, c.w});
}

/// Returns the colour of the line's method. Opacity falls with each earlier pane of the same method, and with the
/// line's age.
ImU32 line_colour(const ViewerState& state, const PaneLine& line) {
    const Method method = settings_of(state, line).render.method;
    ImVec4 c = ImGui::ColorConvertU32ToFloat4(state.layout.theme == Theme::light ? method_ink(method)
                                                                                 : method_colour(method));
    for (std::size_t i = 0; i < line.pane; ++i)
        if (method_of(state, i) == method)
            c.w *= 0.6f;
    c.w *= 1 / (1 + 0.8f * static_cast<float>(line.age));
    return ImGui::ColorConvertFloat4ToU32(c);
}

} // namespace

std::string pane_name(const ViewerState& state, std::size_t pane) {
    return fmt::format("{}  {}", pane + 1, pane_label(state, static_cast<int>(pane)));
}

std::string chart_caveat(const ViewerState& state) {
    if (!state.companions.reference)
        return "~: estimated error of raw samples, from their own variance; bias is not seen.";
    std::string text = reference_caveat(*state.companions.reference);
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        const std::vector<ErrorCurve>& curves = curves_of(state, i);
        const std::size_t all = curves.empty() ? 0 : curves.back().points().back().not_finite;
        if (all > state.companions.reference->not_finite)
            text += fmt::format("{}Pane {}: {} pixels are not finite, and are skipped.", text.empty() ? "" : " ",
                                i + 1, all);
    }
    return text;
}

double efficiency_of(const ErrorPoint& point) {
    return 1 / (point.error * point.seconds);
}

std::vector<std::size_t> panes_with_shifts(const ViewerState& state) {
    std::vector<std::size_t> panes;
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        if (!shifts_of(state, i).points().empty())
            panes.push_back(i);
    return panes;
}

std::vector<ShiftOutcome> occurred_outcomes(const ViewerState& state) {
    std::vector<ShiftOutcome> seen;
    for (int i = 0; i < shift_outcome_count; ++i) {
        const bool any =
            std::any_of(state.charts.by_slot.begin(), state.charts.by_slot.end(), [&](const PaneChart& chart) {
                const auto& points = chart.shifts.points();
                return !points.empty() && points.back().shares[i] > 0;
            });
        if (any)
            seen.push_back(static_cast<ShiftOutcome>(i));
    }
    return seen;
}

Chart viewer_chart(const ViewerState& state) {
    const glm::ivec2 size = state.request_size();
    Chart chart{fmt::format("{}: {}x{}", state.scene_info.name, size.x, size.y), {}};
    if (state.layout.chart_kind == ChartKind::shifts) {
        for (std::size_t pane : panes_with_shifts(state))
            chart.plots.push_back(shift_plot(state, pane));
    } else {
        chart.plots.push_back(error_plot(state));
    }
    return chart;
}

std::vector<ImU32> line_colours(const ViewerState& state) {
    std::vector<ImU32> colours;
    if (state.layout.chart_kind == ChartKind::shifts)
        for (ShiftOutcome outcome : occurred_outcomes(state))
            colours.push_back(readable(outcome_colour(outcome), state.layout.theme));
    else
        for (const PaneLine& line : error_lines(state))
            colours.push_back(line_colour(state, line));
    return colours;
}

ChartPlot histogram_plot(const ViewerState& state) {
    ChartPlot plot{"luminance", "pixels", Scale::log, Scale::linear, {}, {}};
    const auto pane = static_cast<std::size_t>(state.active_pane);
    const auto& histogram = state.charts.of(state.panes[pane]).histogram;
    if (!histogram)
        return plot;
    ChartSeries series{"pixels of " + pane_name(state, pane), {}, false, true};
    for (int bin = 0; bin < Histogram::bin_count; ++bin)
        series.points.push_back(
            {static_cast<double>(Histogram::low_end(bin)), static_cast<double>(histogram->bins[bin]), 0});
    plot.series.push_back(std::move(series));
    return plot;
}

std::optional<Slope> slope_of_last_decade(const ChartSeries& series) {
    constexpr double min_ratio = 3; // of x; the slope between nearer points depends on single samples
    std::vector<glm::dvec2> points;
    std::vector<double> errors;
    for (const ChartPoint& p : series.points)
        if (p.x >= 0.1 * series.points.back().x && p.y > 0) {
            points.emplace_back(p.x, p.y);
            errors.push_back(p.error / p.y);
        }
    if (points.empty() || points.back().x < min_ratio * points.front().x)
        return std::nullopt;
    const Slope slope = log_log_slope(points, errors);
    return std::isfinite(slope.value) && std::isfinite(slope.error) ? std::optional(slope) : std::nullopt;
}

} // namespace tessera
