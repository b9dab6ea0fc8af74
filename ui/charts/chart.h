#pragma once

#include "ui/charts/line_style.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Escapes <, >, & and double quotes for HTML and XML, and replaces control characters by spaces.
std::string escaped(std::string_view text);

/// A tick mark of an axis.
struct ChartTick {
    double value;
    std::string label; ///< empty: a small mark without a label
};

/// One axis of a chart: the mapping of values to positions, and the tick marks.
class ChartAxis {
public:
    enum class Scale { linear, log };

    /// Returns an axis that spans `values` with a margin at both ends. Skips values that are not finite or, on a
    /// log scale, not positive. Without values, the axis spans 1 to 10.
    static ChartAxis spanning(Scale scale, const std::vector<double>& values);
    /// Returns an axis with the names as labels at 0, 1, ...
    static ChartAxis of_names(const std::vector<std::string>& names);

    bool has(double value) const; ///< whether the scale can show the value, inside or outside of [low(), high()]
    /// Returns 0 at the low end and 1 at the high end. has(value) must hold.
    double position(double value) const;
    double low() const { return low_; }
    double high() const { return high_; }
    /// Ticks in increasing order, within [low(), high()]. At least two have labels, except on an axis of names.
    const std::vector<ChartTick>& ticks() const { return ticks_; }

private:
    ChartAxis(Scale scale, double low, double high) : scale_(scale), low_(low), high_(high) {}

    Scale scale_;
    double low_, high_;
    std::vector<ChartTick> ticks_;
};

/// Returns the value with at most four digits: "0.02", "12", "3·10⁻⁵".
std::string chart_number(double value);

struct ChartPoint {
    double x, y;
    double error = 0; ///< half the height of the error bar; 0 or not finite: no bar
};

/// Points connected by a line from left to right. Points that the axes cannot show are skipped.
struct ChartSeries {
    std::string label; ///< text in the key; series with the same label in several plots share one style
    std::vector<ChartPoint> points;
    /// Whether the series is a horizontal line at the first point's y, across the plot and without markers.
    bool is_level = false;
    bool is_dense = false; ///< whether only the last point gets a marker
    LineStyle look{};      ///< without a method, to_svg uses a dashed line if level, else a marker by the label
};

/// One plot: axes and series.
struct ChartPlot {
    std::string x_label, y_label;
    ChartAxis::Scale x_scale = ChartAxis::Scale::linear;
    ChartAxis::Scale y_scale = ChartAxis::Scale::log;
    std::vector<std::string> x_names; ///< if not empty: x is an index into these, and x_scale is ignored
    std::vector<ChartSeries> series;
};

/// Plots side by side below a title, with a common key. to_svg writes a chart; draw_plot (charts.h) draws a plot
/// on the screen.
struct Chart {
    std::string title;
    std::vector<ChartPlot> plots;
};

/// The axes of a plot. They span its points and error bars.
struct ChartAxes {
    ChartAxis x, y;

    bool has(const ChartPoint& p) const { return x.has(p.x) && y.has(p.y); }
};
ChartAxes axes_of(const ChartPlot& plot);

/// Returns the chart as a self-contained SVG file.
std::string to_svg(const Chart& chart);

} // namespace tessera
