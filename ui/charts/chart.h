#pragma once

#include "ui/charts/line_look.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Text as HTML and XML have it: <, >, & and quotes by their names, control characters as spaces.
std::string escaped(std::string_view text);

/// A place on an axis that is marked.
struct ChartTick {
    double value;
    std::string label; ///< empty: a small mark without one
};

/// One axis of a chart: where values lie on it, and what is marked.
class ChartAxis {
public:
    enum class Scale { linear, log };

    /// Spans `values` with some room at both ends. Left out are values that have no place: those that are not
    /// finite and, on a log scale, not positive. Without any left, it spans 1 to 10.
    static ChartAxis spanning(Scale scale, const std::vector<double>& values);
    /// The places 0, 1, ... are named.
    static ChartAxis of_names(const std::vector<std::string>& names);

    bool has(double value) const; ///< whether it has a place on the scale, within the ends or not
    /// 0 at the low end, 1 at the high end. `value` must have a place.
    double position(double value) const;
    double low() const { return low_; }
    double high() const { return high_; }
    /// Rising, within the ends. At least two are labelled, but of names.
    const std::vector<ChartTick>& ticks() const { return ticks_; }

private:
    ChartAxis(Scale scale, double low, double high) : scale_(scale), low_(low), high_(high) {}

    Scale scale_;
    double low_, high_;
    std::vector<ChartTick> ticks_;
};

/// "0.02", "12", "3·10⁻⁵": to at most four digits.
std::string chart_number(double value);

struct ChartPoint {
    double x, y;
    double error = 0; ///< half the height of its error bar; 0 or not finite: none
};

/// Points joined by a line, from left to right. Left out are points that have no place on the axes.
struct ChartSeries {
    std::string label; ///< the key's; series of one label in several plots look alike
    std::vector<ChartPoint> points;
    /// One value for every x: a line without markers at the first point's y, whatever its x.
    bool is_level = false;
    bool is_dense = false; ///< too many points to mark each: the last alone is
    LineLook look{};       ///< without a method: dashed where it is level, else solid, with a marker by its label
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
/// by draw_plot (charts.h).
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
