#include "ui/chart_view.h"

#include "ui/scene_lines.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// The font has no raised digits, as chart_number() would write them.
std::string label(double value) {
    char text[16];
    std::snprintf(text, sizeof text, "%.4g", value + 0.0); // no -0
    return text;
}

void draw_axes(const ScreenRect& plot, const ChartAxes& axes) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    float right_end = plot.min.x - font; // of the last label: none may overlap
    for (const ChartTick& tick : axes.x.ticks()) {
        const float at = glm::mix(plot.min.x, plot.max.x, static_cast<float>(axes.x.position(tick.value)));
        list.AddLine({at, plot.min.y}, {at, plot.max.y},
                     tick.label.empty() ? IM_COL32(128, 128, 128, 25) : colours::line);
        const std::string text = label(tick.value);
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

/// Of what has no place on the scale: the lower end.
float y_of(double y, const ScreenRect& frame, const ChartAxes& axes) {
    const float at =
        axes.y.has(y) ? glm::mix(frame.max.y, frame.min.y, static_cast<float>(axes.y.position(y))) : frame.max.y;
    return std::min(at, frame.max.y);
}

/// One standard error to each side.
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
    draw_axes(frame, axes);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({where.min.x, where.min.y}, colours::dim_text, plot.y_label.c_str());
    list.AddText({frame.max.x - ImGui::CalcTextSize(plot.x_label.c_str()).x, frame.max.y + font * 1.3f},
                 colours::dim_text, plot.x_label.c_str());
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        points.clear();
        for (const ChartPoint& p : plot.series[i].points) {
            if (!axes.has(p))
                continue;
            points.push_back({x_of(p.x, frame, axes), y_of(p.y, frame, axes)});
            draw_bar(p, frame, axes, with_alpha(colours[i], 0.45f));
        }
        list.AddPolyline(points.data(), static_cast<int>(points.size()), colours[i], 0, std::max(font / 8, 1.0f));
        if (!points.empty())
            list.AddCircleFilled(points.back(), font * 0.2f, colours[i]);
    }
}

} // namespace tessera
