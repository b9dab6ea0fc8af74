#include "ui/log_chart.h"
#include "ui/panels.h"
#include "ui/theme.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

namespace tessera {

namespace {

double seconds_of(const ErrorPoint& p) {
    return p.seconds;
}
double spp_of(const ErrorPoint& p) {
    return p.spp;
}
using XOf = double (*)(const ErrorPoint&);

/// Takes room of a height, as an item; where it is.
ScreenRect take_room(float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    ImGui::Dummy({width, height});
    return {{at.x, at.y}, {at.x + width, at.y + height}};
}

/// Panes with one method are told apart by their brightness.
ImU32 line_colour(const ViewerState& state, std::size_t pane) {
    const Method method = state.panes[pane].settings.render.method;
    ImVec4 c = ImGui::ColorConvertU32ToFloat4(method_colour(method));
    for (std::size_t i = 0; i < pane; ++i)
        if (state.panes[i].settings.render.method == method)
            c.w *= 0.6f;
    return ImGui::ColorConvertFloat4ToU32(c);
}

void draw_errors(Controls& controls, const ViewerState& state, XOf x) {
    std::vector<LogChartLine> lines;
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        lines.push_back({line_colour(state, i), {}});
        for (const ErrorPoint& p : state.charts[i].errors.points())
            lines.back().points.emplace_back(x(p), p.error);
    }
    const ScreenRect where = take_room(ImGui::GetFontSize() * 15);
    controls.note("charts.errors",
                  "relMSE of each pane's picture to the reference: the mean of (I - r)^2 / (r^2 + "
                  "0.001) [Bauszat 2017, 4], against what it has taken. Both axes are logarithmic.");
    draw_log_chart(where, x == spp_of ? "samples a pixel" : "seconds", "relMSE", lines);
}

/// A line for each pane: its newest error, slope and efficiency.
void draw_figures(Controls& controls, const ViewerState& state, XOf x) {
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        const auto& points = state.charts[i].errors.points();
        char text[128] = "no error yet";
        if (!points.empty()) {
            const ErrorPoint& p = points.back();
            std::snprintf(text, sizeof text, "%.3g   slope %.2f   eff. %.3g", p.error, log_slope(points, x),
                          1 / (p.error * p.seconds));
        }
        ImGui::PushStyleColor(ImGuiCol_Text, line_colour(state, i));
        ImGui::Text("%d  %s", static_cast<int>(i) + 1,
                    std::string(paper_name(state.panes[i].settings.render.method)).c_str());
        ImGui::PopStyleColor();
        ImGui::SameLine(ImGui::GetFontSize() * 4.5f);
        ImGui::TextUnformatted(text);
        controls.note(
            ("charts.figures" + std::to_string(i)).c_str(),
            "The newest relMSE (no unit); the slope of the line over its last decade, -1 for an error that "
            "falls as noise does; eff.: the efficiency, 1 / (relMSE x seconds), 1/s.");
    }
}

void draw_histogram(Controls& controls, const ViewerState& state) {
    const ScreenRect where = take_room(ImGui::GetFontSize() * 7);
    controls.note(
        "charts.histogram",
        "How many pixels of the active pane's picture have which luminance, from 2^-12 to 2^8, on a square "
        "root scale. The bright line is what the exposure makes white.");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({where.min.x, where.min.y}, {where.max.x, where.max.y}, IM_COL32(128, 128, 128, 25));
    const auto& histogram = state.charts[static_cast<std::size_t>(state.active_pane)].histogram;
    if (!histogram)
        return;
    const auto most = static_cast<float>(
        std::max<std::size_t>(*std::max_element(histogram->bins.begin(), histogram->bins.end()), 1));
    const float step = where.size().x / Histogram::bin_count;
    for (int bin = 0; bin < Histogram::bin_count; ++bin) {
        const float share = std::sqrt(static_cast<float>(histogram->bins[static_cast<std::size_t>(bin)]) / most);
        const float left = where.min.x + step * static_cast<float>(bin);
        list.AddRectFilled({left, glm::mix(where.max.y, where.min.y, share)}, {left + step, where.max.y},
                           colours::dim_text);
    }
    const float stops = static_cast<float>(Histogram::last_stop - Histogram::first_stop);
    const float white = (-state.tone.exposure - Histogram::first_stop) / stops;
    if (white > 0 && white < 1) {
        const float at = glm::mix(where.min.x, where.max.x, white);
        list.AddLine({at, where.min.y}, {at, where.max.y}, colours::accent);
    }
    ImGui::TextDisabled("%zu black   %zu negative   %zu not finite", histogram->black, histogram->negative,
                        histogram->not_finite);
}

void draw_contents(Controls& controls, ViewerState& state) {
    heading("Error");
    static const std::array<ChoiceItem, 2> axes = {{
        {"seconds", "against seconds", "Wall time of a pane's own passes."},
        {"spp", "against samples", "Samples a pixel."},
    }};
    int axis = state.charts_by_spp;
    controls.bare_choice("charts.axis", axes[static_cast<std::size_t>(axis)].label.c_str(), axes, axis, -FLT_MIN,
                         "What the error is shown against.");
    state.charts_by_spp = axis == 1;
    const XOf x = state.charts_by_spp ? spp_of : seconds_of;
    if (state.companions.reference) {
        draw_errors(controls, state, x);
        draw_figures(controls, state, x);
    } else {
        ImGui::TextDisabled("No reference: drop an EXR file on the window");
    }
    heading("Histogram");
    draw_histogram(controls, state);
    if (controls.button("charts.save", "Save as CSV",
                        "Writes the points of all panes, and the histogram, to a CSV file in the current folder."))
        state.save_charts = true;
}

} // namespace

void draw_charts_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Charts", nullptr, side_panel_flags)) {
        ImGui::GetWindowDrawList()->AddLine({where.min.x, where.min.y}, {where.max.x, where.min.y}, colours::line);
        draw_contents(controls, state);
    }
    ImGui::End();
}

} // namespace tessera
