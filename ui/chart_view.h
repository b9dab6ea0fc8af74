#pragma once

#include "ui/chart.h"
#include "ui/screen_rect.h"

#include <span>

#include <imgui.h>

namespace tessera {

/// Draws the axes and lines of a plot in the current window, the last point of each line marked. Error bars,
/// levels and names are the files' alone: the viewer measures none. `colours`: one for each series.
void draw_plot(const ScreenRect& where, const ChartPlot& plot, std::span<const ImU32> colours);

} // namespace tessera
