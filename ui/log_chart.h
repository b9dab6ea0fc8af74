#pragma once

#include "ui/screen_rect.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

/// A line of a chart, in its colour.
struct LogChartLine {
    ImU32 colour;
    std::vector<glm::dvec2> points; ///< what is not above 0 has no place
};

/// Draws lines over two logarithmic axes, in the current window.
void draw_log_chart(const ScreenRect& where, const char* x_title, const char* y_title,
                    const std::vector<LogChartLine>& lines);

} // namespace tessera
