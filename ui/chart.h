#pragma once

#include "ui/chart_axis.h"

#include <string>
#include <vector>

namespace tessera {

struct ChartPoint {
    double x, y;
    double error = 0; ///< half the height of its error bar; 0 or not finite: none
};

/// Points joined by a line, from left to right. Left out are points that have no place on the axes.
struct ChartSeries {
    std::string label; ///< the key's; series of one label in several plots look alike
    std::vector<ChartPoint> points;
    bool is_level = false; ///< one value for every x: a dashed line at the first point's y, whatever its x
    bool is_dense = false; ///< too many points to mark each: the last alone is
};

/// One frame with its axes.
struct ChartPlot {
    std::string x_label, y_label;
    ChartAxis::Scale x_scale = ChartAxis::Scale::linear;
    ChartAxis::Scale y_scale = ChartAxis::Scale::log;
    std::vector<std::string> x_names; ///< if not empty: x is an index into these, and its scale does not count
    std::vector<ChartSeries> series;
};

/// Plots side by side, below a title, with one key for all. Written to a file by to_svg, and drawn on the screen
/// by draw_plot (chart_view.h).
struct Chart {
    std::string title;
    std::vector<ChartPlot> plots;
};

/// The two axes of a plot, which have a place for all of its points and bars that have one on their scales.
struct ChartAxes {
    ChartAxis x, y;

    bool has(const ChartPoint& p) const { return x.has(p.x) && y.has(p.y); }
};
ChartAxes axes_of(const ChartPlot& plot);

/// The chart as an SVG file that needs no other.
std::string to_svg(const Chart& chart);

} // namespace tessera
