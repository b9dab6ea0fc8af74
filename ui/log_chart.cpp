#include "ui/log_chart.h"

#include "ui/chart_axis.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

namespace tessera {

namespace {

std::string label(double value) {
    char text[16];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

ChartAxis spanning(const std::vector<LogChartLine>& lines, int axis) {
    std::vector<double> values;
    for (const LogChartLine& line : lines)
        for (const glm::dvec2& p : line.points)
            values.push_back(p[axis]);
    return ChartAxis::spanning(ChartAxis::Scale::log, values);
}

void draw_axes(const ScreenRect& plot, const ChartAxis& x, const ChartAxis& y) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    float right_end = plot.min.x - font; // of the last label: none may overlap
    for (const ChartTick& tick : x.ticks()) {
        const float at = glm::mix(plot.min.x, plot.max.x, static_cast<float>(x.position(tick.value)));
        list.AddLine({at, plot.min.y}, {at, plot.max.y},
                     tick.label.empty() ? IM_COL32(128, 128, 128, 25) : colours::line);
        const std::string text = label(tick.value);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (tick.label.empty() || at - width * 0.5f < right_end + font * 0.5f)
            continue;
        list.AddText({at - width * 0.5f, plot.max.y + font * 0.15f}, colours::dim_text, text.c_str());
        right_end = at + width * 0.5f;
    }
    for (const ChartTick& tick : y.ticks()) {
        const float at = glm::mix(plot.max.y, plot.min.y, static_cast<float>(y.position(tick.value)));
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

} // namespace

void draw_log_chart(const ScreenRect& where, const char* x_title, const char* y_title,
                    const std::vector<LogChartLine>& lines) {
    const float font = ImGui::GetFontSize();
    const ScreenRect plot{{where.min.x + font * 3.4f, where.min.y + font * 1.3f},
                          {where.max.x - font * 0.6f, where.max.y - font * 2.5f}};
    if (plot.size().x < font || plot.size().y < font)
        return;
    const ChartAxis x = spanning(lines, 0), y = spanning(lines, 1);
    draw_axes(plot, x, y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({where.min.x, where.min.y}, colours::dim_text, y_title);
    list.AddText({plot.max.x - ImGui::CalcTextSize(x_title).x, plot.max.y + font * 1.3f}, colours::dim_text,
                 x_title);
    std::vector<ImVec2> points;
    for (const LogChartLine& line : lines) {
        points.clear();
        for (const glm::dvec2& p : line.points) {
            if (x.has(p.x) && y.has(p.y))
                points.push_back({glm::mix(plot.min.x, plot.max.x, static_cast<float>(x.position(p.x))),
                                  glm::mix(plot.max.y, plot.min.y, static_cast<float>(y.position(p.y)))});
        }
        list.AddPolyline(points.data(), static_cast<int>(points.size()), line.colour, 0, std::max(font / 8, 1.0f));
        if (!points.empty())
            list.AddCircleFilled(points.back(), font * 0.2f, line.colour);
    }
}

} // namespace tessera
