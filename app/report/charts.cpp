#include "app/report/reports.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <fmt/core.h>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

/// Returns the look of a line: dashes show the norm, markers the values of the variations from index `first` on.
LineStyle look_of(const ExperimentOptions& options, const Result& result, std::size_t first) {
    const PictureSettings& s = result.setup.settings;
    std::ptrdiff_t marker = 0;
    for (std::size_t i = first; i < options.variations.size(); ++i) {
        const std::vector<std::string>& values = options.variations[i].values;
        const auto found = std::find(values.begin(), values.end(), result.setup.values[i]);
        const std::ptrdiff_t place = found == values.end() ? 0 : found - values.begin();
        marker = marker * static_cast<std::ptrdiff_t>(values.size()) + place;
    }
    return {s.render.method, s.reconstruction.norm, static_cast<int>(marker)};
}

/// Returns the plot `axes` with a line for each curve. Omits points with a y that is not finite.
/// @param point_of  maps a result to a point
template <typename PointOf>
ChartPlot with_curves(ChartPlot axes, const ExperimentOptions& options, const SceneCurves& scene,
                      PointOf point_of) {
    for (const Curve& curve : scene.curves) {
        ChartSeries series{curve_label(options, curve), {}, false, false, look_of(options, last_of(curve), 0)};
        for (const Result& r : curve)
            if (const ChartPoint point = point_of(r); std::isfinite(point.y))
                series.points.push_back(point);
        axes.series.push_back(series);
    }
    return axes;
}

ChartPlot error_plot(const ExperimentOptions& options, const SceneCurves& scene, const char* x_label,
                     double (*x)(const Result&)) {
    const char* const bars = options.seeds > 1 ? "standard deviation over seeds" : "uncertainty";
    const ChartPlot axes{x_label,
                         fmt::format("relMSE, floor-free (bars: {})", bars),
                         ChartAxis::Scale::log,
                         ChartAxis::Scale::log,
                         {},
                         {}};
    ChartPlot plot = with_curves(axes, options, scene, [x](const Result& r) {
        return ChartPoint{x(r), is_significant(r) ? error_of(r) : std::numeric_limits<double>::quiet_NaN(),
                          r.runs.size() > 1 ? error_deviation(r) : error_uncertainty(r)};
    });
    for (std::size_t i = 0; i < scene.curves.size(); ++i)
        if (const double slope = slope_of(scene.curves[i]); std::isfinite(slope))
            plot.series[i].label += fmt::format(" (slope {:.2f})", slope);
    return plot;
}

/// Returns a plot of a column of the results against CPU seconds.
ChartPlot seen_plot(const ExperimentOptions& options, const SceneCurves& scene, const char* column,
                    const char* label, ChartAxis::Scale scale) {
    return with_curves(
        {"CPU seconds", label, ChartAxis::Scale::log, scale, {}, {}}, options, scene,
        [column](const Result& r) { return ChartPoint{cpu_seconds_of(r), column_value(column, r), 0}; });
}

} // namespace

std::string curve_label(const ExperimentOptions& options, const Curve& curve) {
    const Result& result = last_of(curve);
    std::string label = line_label(options, result);
    if (!options.variations.empty() && !result.setup.values.front().empty())
        label += fmt::format(", {} {}", options.variations.front().variable.id, result.setup.values.front());
    return label;
}

namespace {

std::string bench_title(const ExperimentOptions& options, const SceneCurves& scene) {
    const glm::ivec2 size = options.settings.size;
    return fmt::format("{}: {}x{}, depth {}, {} each, {} seed{}", scene.name, size.x, size.y,
                       options.settings.render.max_depth, to_string(options.effort), options.seeds,
                       options.seeds > 1 ? "s" : "");
}

} // namespace

Chart bench_chart(const ExperimentOptions& options, const SceneCurves& scene) {
    return {bench_title(options, scene),
            {error_plot(options, scene, "CPU seconds", cpu_seconds_of),
             error_plot(options, scene, "samples per pixel", spp_of)}};
}

Chart seen_chart(const ExperimentOptions& options, const SceneCurves& scene) {
    return {bench_title(options, scene),
            {seen_plot(options, scene, "psnr", "PSNR, dB", ChartAxis::Scale::linear),
             seen_plot(options, scene, "flip", "FLIP", ChartAxis::Scale::log)}};
}

Chart triangle_chart(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes) {
    ChartPlot plot{
        "triangles", "millions of samples per CPU second", ChartAxis::Scale::log, ChartAxis::Scale::log, {}, {}};
    for (Method method : all_methods) {
        ChartSeries series{std::string(short_name(method)), {}, false, false, {method, Norm::weighted, 0}};
        for (const SceneCurves& scene : scenes)
            if (const Curve* curve = best_curve(scene, method)) {
                const Result& r = last_of(*curve);
                const glm::ivec2 size = r.setup.settings.size;
                const double samples = 1e-6 * size.x * size.y * spp_of(r);
                series.points.push_back({static_cast<double>(r.triangles), samples / cpu_seconds_of(r), 0});
            }
        if (!series.points.empty())
            plot.series.push_back(series);
    }
    return {fmt::format("Speed by scene size, {}", to_string(options.effort)), {plot}};
}

namespace {

std::string title(const ExperimentOptions& options, const std::string& scene) {
    const auto is_size = [](const Variation& v) { return v.variable.id == "size"; };
    const bool has_sizes = std::any_of(options.variations.begin(), options.variations.end(), is_size);
    const glm::ivec2 size = options.settings.size;
    return fmt::format("{}: {}{}{}", scene, has_sizes ? "" : fmt::format("{}x{}, ", size.x, size.y),
                       to_string(options.effort),
                       options.seeds > 1 ? fmt::format(", {} seeds", options.seeds) : "");
}

/// Returns the values of a variation as numbers; empty if they are words.
std::vector<double> numbers_of(const Variation& variation) {
    std::vector<double> numbers;
    PictureSettings settings;
    for (const std::string& value : variation.values) {
        variation.variable.set_text(settings, value);
        if (const std::optional<double> number = variation.variable.number(settings))
            numbers.push_back(*number);
    }
    return numbers;
}

/// The x axis of the plots.
struct Abscissa {
    std::string label;
    std::vector<std::string> values;
    std::vector<double> numbers; ///< positions of the values
    ChartAxis::Scale scale = ChartAxis::Scale::linear;
    bool has_names = true;

    double at(const std::string& value) const {
        const auto found = std::find(values.begin(), values.end(), value);
        return found == values.end() ? 0 : numbers[static_cast<std::size_t>(found - values.begin())];
    }
};

Abscissa abscissa_of(const ExperimentOptions& options) {
    Abscissa x;
    if (options.variations.empty()) {
        x.label = "method";
        for (Method method : options.methods)
            x.values.emplace_back(short_name(method));
    } else {
        const Variation& first = options.variations.front();
        x.label = first.variable.label;
        x.values = first.values;
        x.numbers = numbers_of(first);
    }
    if (!x.numbers.empty()) {
        const auto [smallest, largest] = std::minmax_element(x.numbers.begin(), x.numbers.end());
        // Wide ranges, such as 0, 0.01, 0.1, 1, need a log axis, which has no place for 0.
        const bool is_wide = *largest >= 8 * *smallest;
        x.scale = is_wide && *smallest > 0 ? ChartAxis::Scale::log : ChartAxis::Scale::linear;
        x.has_names = is_wide && *smallest <= 0;
    }
    if (x.has_names) {
        x.numbers.clear();
        for (std::size_t i = 0; i < x.values.size(); ++i)
            x.numbers.push_back(static_cast<double>(i));
    }
    return x;
}

ChartSeries& series_named(std::vector<ChartSeries>& all, const std::string& label) {
    const auto has_label = [&](const ChartSeries& s) { return s.label == label; };
    const auto found = std::find_if(all.begin(), all.end(), has_label);
    if (found != all.end())
        return *found;
    return all.emplace_back(ChartSeries{label, {}, false});
}

/// Returns a plot of the results. `point_of(x, result)` returns a point.
template <typename PointOf>
ChartPlot plot_of(const ExperimentOptions& options, const std::vector<Result>& results, const std::string& y_label,
                  PointOf point_of) {
    const Abscissa x = abscissa_of(options);
    ChartPlot plot{x.label, y_label, x.scale, ChartAxis::Scale::log, {}, {}};
    if (x.has_names)
        plot.x_names = x.values;
    for (const Result& result : results) {
        const std::string value = options.variations.empty()
                                      ? std::string(short_name(result.setup.settings.render.method))
                                      : result.setup.values.front();
        ChartSeries& series = series_named(plot.series, line_label(options, result));
        series.look = look_of(options, result, 1);
        series.is_level = value.empty();
        series.points.push_back(point_of(x.at(value), result));
    }
    return plot;
}

} // namespace

Chart sweep_chart(const ExperimentOptions& options, const std::vector<Result>& results) {
    const char* const bars = options.seeds > 1 ? "standard deviation over seeds" : "uncertainty";
    const auto error = [&](double x, const Result& r) {
        const double certain = is_significant(r) ? error_of(r) : std::numeric_limits<double>::quiet_NaN();
        return ChartPoint{x, certain, options.seeds > 1 ? error_deviation(r) : error_uncertainty(r)};
    };
    const auto efficiency = [](double x, const Result& r) { return ChartPoint{x, efficiency_of(r), 0}; };
    const auto speed = [](double x, const Result& r) { return ChartPoint{x, speed_of(r), 0}; };
    return {title(options, results.front().title()),
            {plot_of(options, results, fmt::format("relMSE, floor-free (bars: {})", bars), error),
             plot_of(options, results, "efficiency, 1 / (relMSE × CPU seconds)", efficiency),
             plot_of(options, results, "millions of samples per wall second", speed)}};
}

std::vector<Chart> sweep_charts(const ExperimentOptions& options, const std::vector<Result>& results) {
    std::vector<Chart> charts;
    for (auto begin = results.begin(); begin != results.end();) {
        const auto end =
            std::find_if(begin, results.end(), [&](const Result& r) { return r.title() != begin->title(); });
        charts.push_back(sweep_chart(options, {begin, end}));
        begin = end;
    }
    return charts;
}

} // namespace tessera
