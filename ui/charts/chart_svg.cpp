#include "ui/charts/chart.h"
#include "ui/gl/theme.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace tessera {

namespace {

// All sizes are in pixels.
constexpr double frame_width = 400, frame_height = 300;
constexpr double left_room = 78, right_room = 22, bottom_room = 66, title_height = 46;
constexpr double key_line = 22, key_sample = 46, letter_width = 7.2;

/// Palette of Okabe and Ito, which is distinguishable with colour-blindness.
constexpr std::string_view colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                       "#e69f00", "#56b4e9", "#000000", "#8c510a"};

class SvgWriter {
public:
    explicit SvgWriter(const Chart& chart) : chart_(chart) {
        for (const ChartPlot& plot : chart.plots)
            for (const ChartSeries& series : plot.series)
                if (std::find(labels_.begin(), labels_.end(), series.label) == labels_.end()) {
                    labels_.push_back(series.label);
                    styles_.push_back(style_of(series, labels_.size() - 1));
                }
    }

    std::string write() {
        const double plots = std::max(1.0, static_cast<double>(chart_.plots.size()));
        const double width = plots * (left_room + frame_width + right_room);
        const int columns = key_columns(width);
        const double key_top = title_height + frame_height + bottom_room;
        const double rows = std::ceil(static_cast<double>(labels_.size()) / columns);
        const double height = key_top + key_line * rows + 12;
        add(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:g}" height="{1:g}" viewBox="0 0 {0:g} {1:g}" )"
            R"(font-family="Inter, DejaVu Sans, Helvetica, Arial, sans-serif" font-size="13" fill="#222">)",
            width, height);
        add(R"(<rect width="{:g}" height="{:g}" fill="#fff"/>)", width, height);
        text(width / 2, 27, "middle", chart_.title, R"(font-size="16" font-weight="600")");
        double left = left_room;
        for (const ChartPlot& plot : chart_.plots) {
            draw_plot(plot, left);
            left += frame_width + right_room + left_room;
        }
        draw_key(key_top, columns);
        add("</svg>");
        return out_;
    }

private:
    struct Style {
        std::string color;
        std::string dashes; // stroke-dasharray attribute; empty: solid
        int marker = 0;
        bool is_level = false; // without markers
    };
    struct Frame {
        double left;
        ChartAxes axes;

        double at_x(double value) const { return left + frame_width * axes.x.position(value); }
        double at_y(double value) const { return title_height + frame_height * (1 - axes.y.position(value)); }
        double bottom() const { return title_height + frame_height; }
    };

    template <typename... T>
    void add(fmt::format_string<T...> format, T&&... values) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
        out_ += '\n';
    }

    void text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "") {
        add(R"(<text x="{:.6g}" y="{:.6g}" text-anchor="{}" {}>{}</text>)", x, y, anchor, more, escaped(words));
    }

    void line(double x1, double y1, double x2, double y2, std::string_view stroke, std::string_view more = "") {
        add(R"(<line x1="{:.6g}" y1="{:.6g}" x2="{:.6g}" y2="{:.6g}" stroke="{}" {}/>)", x1, y1, x2, y2, stroke,
            more);
    }

    void draw_plot(const ChartPlot& plot, double left) {
        const Frame frame{left, axes_of(plot)};
        draw_axes(plot, frame);
        for (const ChartSeries& series : plot.series)
            draw_series(series, frame);
    }

    void draw_axes(const ChartPlot& plot, const Frame& f) {
        const double right = f.left + frame_width;
        for (const ChartTick& tick : f.axes.y.ticks()) {
            const double y = f.at_y(tick.value);
            line(f.left, y, right, y, tick.label.empty() ? "#f2f2f2" : "#d8d8d8");
            text(f.left - 8, y + 4.5, "end", tick.label);
        }
        bool lower = false; // crowded labels alternate between two lines
        for (const ChartTick& tick : f.axes.x.ticks()) {
            const double x = f.at_x(tick.value);
            line(x, f.bottom(), x, f.bottom() + (tick.label.empty() ? 3 : 6), "#222");
            text(x, f.bottom() + (lower ? 35 : 21), "middle", tick.label);
            if (!tick.label.empty())
                lower = !lower && are_crowded(f.axes.x.ticks());
        }
        add(R"(<rect x="{:g}" y="{:g}" width="{:g}" height="{:g}" fill="none" stroke="#222"/>)", f.left,
            title_height, frame_width, frame_height);
        text(f.left + frame_width / 2, f.bottom() + (are_crowded(f.axes.x.ticks()) ? 53 : 43), "middle",
             plot.x_label);
        const double x = f.left - left_room + 16, y = title_height + frame_height / 2;
        text(x, y, "middle", plot.y_label, fmt::format("transform=\"rotate(-90 {:g} {:g})\"", x, y));
    }

    static bool are_crowded(const std::vector<ChartTick>& ticks) {
        std::size_t longest = 0, count = 0;
        for (const ChartTick& tick : ticks) {
            longest = std::max(longest, tick.label.size());
            count += !tick.label.empty();
        }
        return letter_width * static_cast<double>(longest * count) > frame_width;
    }

    void draw_series(const ChartSeries& series, const Frame& f) {
        const Style& style = styles_[index_of(series.label)];
        std::vector<ChartPoint> points = series.points;
        if (series.is_level) {
            points.resize(std::min<std::size_t>(points.size(), 1));
            if (!points.empty() && f.axes.y.has(points[0].y))
                draw_sample(f.left, f.left + frame_width, f.at_y(points[0].y), style);
            return;
        }
        points.erase(std::remove_if(points.begin(), points.end(), [&](const auto& p) { return !f.axes.has(p); }),
                     points.end());
        std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
        std::string path;
        for (const ChartPoint& p : points)
            path += fmt::format("{:.6g},{:.6g} ", f.at_x(p.x), f.at_y(p.y));
        add(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2"{}/>)", path, style.color,
            style.dashes);
        for (const ChartPoint& p : points) {
            draw_error(p, f, style.color);
            if (!series.is_dense || &p == &points.back())
                draw_marker(f.at_x(p.x), f.at_y(p.y), style);
        }
    }

    void draw_error(const ChartPoint& p, const Frame& f, std::string_view stroke) {
        if (!std::isfinite(p.error) || p.error <= 0)
            return;
        const double x = f.at_x(p.x), top = f.at_y(p.y + p.error), low = p.y - p.error;
        const bool ends = f.axes.y.has(low) && low >= f.axes.y.low(); // otherwise the frame clips the bar
        const double bottom = ends ? f.at_y(low) : f.bottom();
        constexpr std::string_view faint = R"(stroke-opacity="0.6")"; // keeps overlapping bars distinguishable
        line(x, top, x, bottom, stroke, faint);
        line(x - 4, top, x + 4, top, stroke, faint);
        if (ends)
            line(x - 4, bottom, x + 4, bottom, stroke, faint);
    }

    void draw_marker(double x, double y, const Style& style) {
        constexpr double r = 4;
        const std::string_view fill = style.color;
        const int marker = style.marker % line_markers;
        if (marker == 0)
            add(R"(<circle cx="{:.6g}" cy="{:.6g}" r="{:g}" fill="{}"/>)", x, y, r, fill);
        else if (marker == 1)
            add(R"(<rect x="{:.6g}" y="{:.6g}" width="{:g}" height="{:g}" fill="{}"/>)", x - r, y - r, 2 * r,
                2 * r, fill);
        else if (marker == 2)
            add(R"(<path d="M{:.6g},{:.6g} l{:g},{:g} h{:g} z" fill="{}"/>)", x, y - 1.3 * r, 1.2 * r, 2.2 * r,
                -2.4 * r, fill);
        else
            add(R"(<path d="M{:.6g},{:.6g} l{:g},{:g} l{:g},{:g} l{:g},{:g} z" fill="{}"/>)", x, y - 1.4 * r,
                1.4 * r, 1.4 * r, -1.4 * r, 1.4 * r, -1.4 * r, -1.4 * r, fill);
    }

    void draw_sample(double x1, double x2, double y, const Style& style) {
        line(x1, y, x2, y, style.color, fmt::format(R"(stroke-width="2"{})", style.dashes));
        if (!style.is_level)
            draw_marker((x1 + x2) / 2, y, style);
    }

    double key_width() const {
        std::size_t longest = 0;
        for (const std::string& label : labels_)
            longest = std::max(longest, label.size());
        return key_sample + 8 + letter_width * static_cast<double>(longest) + 24;
    }

    int key_columns(double width) const {
        const int fit = static_cast<int>((width - left_room - right_room) / key_width());
        return std::clamp(fit, 1, std::max(1, static_cast<int>(labels_.size())));
    }

    void draw_key(double top, int columns) {
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            const double x = left_room + key_width() * static_cast<double>(i % static_cast<std::size_t>(columns));
            const double y = top + key_line * (static_cast<double>(i / static_cast<std::size_t>(columns)) + 0.5);
            draw_sample(x, x + key_sample, y, styles_[i]);
            text(x + key_sample + 8, y + 4.5, "start", labels_[i]);
        }
    }

    std::size_t index_of(const std::string& label) const {
        return static_cast<std::size_t>(std::find(labels_.begin(), labels_.end(), label) - labels_.begin());
    }

    /// Returns the style of a series. `index` is the index of its label in labels_.
    static Style style_of(const ChartSeries& series, std::size_t index) {
        Style style{std::string(colors[index % std::size(colors)]), "", static_cast<int>(index), series.is_level};
        if (!series.look.method) {
            style.dashes = series.is_level ? R"( stroke-dasharray="7 5")" : "";
            return style;
        }
        const ImU32 ink = method_ink(*series.look.method);
        style.color = fmt::format("#{:02x}{:02x}{:02x}", ink >> IM_COL32_R_SHIFT & 255,
                                  ink >> IM_COL32_G_SHIFT & 255, ink >> IM_COL32_B_SHIFT & 255);
        style.marker = series.look.marker;
        for (float length : dashes_of(series.look)) // in units of the line width, which is 2 pixels
            style.dashes +=
                fmt::format("{}{:g}", style.dashes.empty() ? R"( stroke-dasharray=")" : " ", 2 * length);
        style.dashes += style.dashes.empty() ? "" : "\"";
        return style;
    }

    const Chart& chart_;
    std::vector<std::string> labels_;
    std::vector<Style> styles_; // in the order of labels_
    std::string out_;
};

} // namespace

std::string to_svg(const Chart& chart) {
    return SvgWriter(chart).write();
}

} // namespace tessera
