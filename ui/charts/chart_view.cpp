#include "ui/charts/charts.h"
#include "ui/gl/gl.h"
#include "ui/gl/gui.h"
#include "ui/gl/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// Formats a number without superscripts, which the font lacks and chart_number() uses.
std::string label(double value) {
    char text[16];
    std::snprintf(text, sizeof text, "%.4g", value + 0.0); // no -0
    return text;
}

void draw_axes(const ScreenRect& plot, const ChartAxes& axes, bool has_names) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    float right_end = plot.min.x - font; // of the last label drawn; overlapping labels are skipped
    for (const ChartTick& tick : axes.x.ticks()) {
        const float at = glm::mix(plot.min.x, plot.max.x, static_cast<float>(axes.x.position(tick.value)));
        list.AddLine({at, plot.min.y}, {at, plot.max.y},
                     tick.label.empty() ? IM_COL32(128, 128, 128, 25) : colours::line);
        const std::string text = has_names ? tick.label : label(tick.value);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (tick.label.empty() || at - width * 0.5f < right_end + font * 0.5f)
            continue;
        list.AddText({at - width * 0.5f, plot.max.y + font * 0.15f}, colours::dim_text, text.c_str());
        right_end = at + width * 0.5f;
    }
    for (const ChartTick& tick : axes.y.ticks()) {
        const float at = glm::mix(plot.max.y, plot.min.y, static_cast<float>(axes.y.position(tick.value)));
        list.AddLine({plot.min.x, at}, {plot.max.x, at},
                     tick.label.empty() ? IM_COL32(128, 128, 128, 25) : colours::line);
        if (tick.label.empty())
            continue;
        const std::string text = label(tick.value);
        list.AddText({plot.min.x - font * 0.3f - ImGui::CalcTextSize(text.c_str()).x, at - font * 0.5f},
                     colours::dim_text, text.c_str());
    }
    list.AddRect({plot.min.x, plot.min.y}, {plot.max.x, plot.max.y}, colours::line);
}

float x_of(double x, const ScreenRect& frame, const ChartAxes& axes) {
    return glm::mix(frame.min.x, frame.max.x, static_cast<float>(axes.x.position(x)));
}

/// Returns the screen position of y. Values that the scale cannot show lie at its lower end.
float y_of(double y, const ScreenRect& frame, const ChartAxes& axes) {
    const float at =
        axes.y.has(y) ? glm::mix(frame.max.y, frame.min.y, static_cast<float>(axes.y.position(y))) : frame.max.y;
    return std::min(at, frame.max.y);
}

/// Draws an error bar of one standard error to each side of the point.
void draw_bar(const ChartPoint& p, const ScreenRect& frame, const ChartAxes& axes, ImU32 colour) {
    if (!std::isfinite(p.error) || p.error <= 0)
        return;
    const float x = x_of(p.x, frame, axes);
    ImGui::GetWindowDrawList()->AddLine({x, y_of(p.y + p.error, frame, axes)},
                                        {x, y_of(p.y - p.error, frame, axes)}, colour,
                                        std::max(ImGui::GetFontSize() / 12, 1.0f));
}

} // namespace

void draw_plot(const ScreenRect& where, const ChartPlot& plot, std::span<const ImU32> colours) {
    const float font = ImGui::GetFontSize();
    const ScreenRect frame{{where.min.x + font * 3.4f, where.min.y + font * 1.3f},
                           {where.max.x - font * 0.6f, where.max.y - font * 2.5f}};
    if (frame.size().x < font || frame.size().y < font)
        return;
    const ChartAxes axes = axes_of(plot);
    draw_axes(frame, axes, !plot.x_names.empty());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({where.min.x, where.min.y}, colours::dim_text, plot.y_label.c_str());
    list.AddText({frame.max.x - ImGui::CalcTextSize(plot.x_label.c_str()).x, frame.max.y + font * 1.3f},
                 colours::dim_text, plot.x_label.c_str());
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        points.clear();
        const ChartSeries& series = plot.series[i];
        if (series.is_level && !series.points.empty() && axes.y.has(series.points.front().y)) {
            const float y = y_of(series.points.front().y, frame, axes);
            draw_dashed(std::array{ImVec2(frame.min.x, y), ImVec2(frame.max.x, y)}, dashes_of(series.look),
                        colours[i], std::max(font / 8, 1.0f));
            continue;
        }
        for (const ChartPoint& p : series.points) {
            if (!axes.has(p))
                continue;
            points.push_back({x_of(p.x, frame, axes), y_of(p.y, frame, axes)});
            draw_bar(p, frame, axes, with_alpha(colours[i], 0.45f));
        }
        const LineStyle& look = series.look;
        draw_dashed(points, dashes_of(look), colours[i], std::max(font / 8, 1.0f));
        if (!points.empty())
            draw_marker(points.back(), look.marker, font * 0.22f, colours[i]);
    }
}

namespace {

/// Returns the size of chart_picture() in font sizes. The height grows with the number of plots and of lines.
glm::vec2 size_of_picture(const ViewerState& state) {
    const auto plots = static_cast<float>(viewer_chart(state).plots.size());
    const auto lines = static_cast<float>(line_colours(state).size()); // lines of figures below the plots
    const float histogram_and_text = 12;
    return {64, (plots > 0 ? std::max(24.0f, 14 * plots) : 0) + 1.5f * lines + histogram_and_text};
}

/// A second context of Dear ImGui with the fonts and style of the first, in a new frame. It is current during the
/// object's lifetime.
class OffscreenFrame {
public:
    explicit OffscreenFrame(glm::vec2 size) : main_(ImGui::GetCurrentContext()) {
        const ImGuiStyle style = ImGui::GetStyle();
        const ImGuiIO& look = ImGui::GetIO();
        own_ = ImGui::CreateContext(look.Fonts);
        ImGui::SetCurrentContext(own_);
        ImGui::GetStyle() = style;
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = io.LogFilename = nullptr;
        io.FontDefault = look.FontDefault;
        io.BackendFlags = look.BackendFlags; // the same backend draws it
        io.DisplaySize = {size.x, size.y};
        ImGui::NewFrame();
    }
    ~OffscreenFrame() {
        ImGui::SetCurrentContext(main_);
        ImGui::DestroyContext(own_);
    }
    OffscreenFrame(const OffscreenFrame&) = delete;
    OffscreenFrame& operator=(const OffscreenFrame&) = delete;

    /// Ends the frame, and draws it over the whole bound framebuffer.
    void draw() const {
        ImGui::Render();
        ImDrawData* drawn = ImGui::GetDrawData();
        ImGui::SetCurrentContext(main_); // which has the backend
        draw_over_all(*drawn);
        ImGui::SetCurrentContext(own_);
    }

private:
    ImGuiContext *main_, *own_ = nullptr;
};

} // namespace

ScreenPixels chart_picture(const ViewerState& state) {
    const glm::vec2 size = glm::ceil(ImGui::GetFontSize() * size_of_picture(state));
    const OffscreenFrame frame(size);
    Controls no_input; // of this picture only
    draw_large_charts({glm::vec2(0), size}, no_input, state);
    Framebuffer target;
    target.resize(glm::ivec2(size));
    const DrawInto drawing(target);
    frame.draw();
    return read_screen(target.size());
}

namespace {

/// Returns the norm and alpha, such as "weighted,0.2". Alpha is empty if the norm is none.
std::string reconstruction_columns(const ReconstructionSettings& s) {
    if (s.norm == Norm::none)
        return "none,";
    return fmt::format("{},{:.6g}", to_string(s.norm), s.alpha);
}

std::string error_lines(const ViewerState& state) {
    std::string text = "pane,method,norm,alpha,spp,seconds,relMSE,standard_error,efficiency,"
                       "not_finite,estimated\n";
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        for (const ErrorCurve& curve : state.charts.of(state.panes[i]).curves)
            for (const ErrorPoint& p : curve.points())
                text += fmt::format("{},{},{},{},{:.6g},{:.7g},{},{:.7g},{},{}\n", i + 1, short_name(curve.method),
                                    reconstruction_columns(curve.reconstruction), p.spp, p.seconds, p.error,
                                    std::isfinite(p.standard_error) ? fmt::format("{:.3g}", p.standard_error) : "",
                                    efficiency_of(p), p.not_finite,
                                    static_cast<int>(!state.charts.of(state.panes[i]).reference));
    return text;
}

std::string shift_lines(const ViewerState& state) {
    std::string header = "\npane,method,spp,seconds", text;
    for (int i = 0; i < shift_outcome_count; ++i)
        header += fmt::format(",{}", to_string(static_cast<ShiftOutcome>(i)));
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        for (const ShiftPoint& p : state.charts.of(state.panes[i]).shifts.points()) {
            text += fmt::format("{},{},{},{:.6g}", i + 1, short_name(p.method), p.spp, p.seconds);
            for (double share : p.shares)
                text += fmt::format(",{:.6g}", share);
            text += '\n';
        }
    }
    return text.empty() ? "" : header + "\n" + text;
}

std::string histogram_lines(const ViewerState& state) {
    const auto& histogram = state.charts.of(state.active()).histogram;
    if (!histogram)
        return "";
    std::string text = "\nluminance,pixels\n";
    for (int bin = 0; bin < Histogram::bin_count; ++bin)
        text += fmt::format("{:.6g},{}\n", Histogram::low_end(bin), histogram->bins[bin]);
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
            const std::optional<Slope> slope = slope_of_last_decade(series);
            if (state.layout.chart_kind == ChartKind::error && slope)
                series.label += fmt::format(" (slope {:.2f} ± {:.2f})", slope->value, slope->error);
        }
    }
    if (ChartPlot histogram = histogram_plot(state); !histogram.series.empty())
        chart.plots.push_back(std::move(histogram));
    return to_svg(chart);
}

} // namespace tessera
