#include "app/bench_chart.h"

#include "app/result_files.h"

#include <cmath>

#include <fmt/core.h>

namespace tessera {

namespace {

ChartPlot plot_of(const ExperimentOptions& options, const SceneCurves& scene, const char* x_label,
                  double (*x)(const Result&)) {
    const char* const bars = options.seeds > 1 ? "deviation of seeds" : "uncertainty";
    ChartPlot plot{x_label,
                   fmt::format("relMSE, floor-free (bars: {})", bars),
                   ChartAxis::Scale::log,
                   ChartAxis::Scale::log,
                   {},
                   {}};
    for (const Curve& curve : scene.curves) {
        const double slope = slope_of(curve);
        ChartSeries series{curve_label(options, curve), {}, false};
        if (std::isfinite(slope))
            series.label += fmt::format(" (slope {:.2f})", slope);
        for (const Result& r : curve)
            if (is_certain(r))
                series.points.push_back(
                    {x(r), error_of(r), r.runs.size() > 1 ? error_deviation(r) : error_uncertainty(r)});
        plot.series.push_back(series);
    }
    return plot;
}

} // namespace

std::string curve_label(const ExperimentOptions& options, const Curve& curve) {
    const Result& result = last_of(curve);
    std::string label = line_label(options, result);
    if (!options.variations.empty() && !result.point.values.front().empty())
        label += fmt::format(", {} {}", options.variations.front().variable.id, result.point.values.front());
    return label;
}

Chart bench_chart(const ExperimentOptions& options, const SceneCurves& scene) {
    const glm::ivec2 size = options.settings.size;
    const std::string title = fmt::format("{}: {}x{}, depth {}, {} each, {} seed{}", scene.name, size.x, size.y,
                                          options.settings.render.max_depth, to_string(options.effort),
                                          options.seeds, options.seeds > 1 ? "s" : "");
    return {title,
            {plot_of(options, scene, "CPU seconds", cpu_seconds_of),
             plot_of(options, scene, "samples a pixel", spp_of)}};
}

Chart triangle_chart(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes) {
    ChartPlot plot{
        "triangles", "millions of samples a CPU second", ChartAxis::Scale::log, ChartAxis::Scale::log, {}, {}};
    for (Method method : all_methods) {
        ChartSeries series{std::string(short_name(method)), {}, false};
        for (const SceneCurves& scene : scenes)
            if (const Curve* curve = best_curve(scene, method)) {
                const Result& r = last_of(*curve);
                const glm::ivec2 size = r.point.settings.size;
                const double samples = 1e-6 * size.x * size.y * spp_of(r);
                series.points.push_back({static_cast<double>(r.triangles), samples / cpu_seconds_of(r), 0});
            }
        if (!series.points.empty())
            plot.series.push_back(series);
    }
    return {fmt::format("Speed by size of the scene, {}", to_string(options.effort)), {plot}};
}

} // namespace tessera
