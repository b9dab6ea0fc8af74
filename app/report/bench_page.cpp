#include "app/cli/terminal.h"
#include "app/report/page.h"
#include "app/report/reports.h"
#include "recon/enumeration.h"
#include "render/settings/settings_table.h"

#include <cmath>
#include <thread>

#include <fmt/core.h>

namespace tessera {

namespace {

std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

/// An error below its uncertainty is shown as an upper bound.
std::string error_text(const Result& r) {
    return is_significant(r) ? fmt::format("{:.3g} ± {:.1g}", error_of(r), error_uncertainty(r))
                             : fmt::format("&lt; {:.2g}", error_uncertainty(r));
}

std::string speed_up_cell(const SceneCurves& scene, Method slower) {
    const Curve *slow = best_curve(scene, slower), *fast = best_curve(scene, Method::gpr);
    if (!slow || !fast)
        return "<td>–</td>";
    const SpeedUp s = speed_up(*slow, *fast);
    return fmt::format("<td title=\"at relMSE {}\">{}</td>", number(s.error), to_string(s));
}

std::string speed_up_section(const std::vector<SceneCurves>& scenes) {
    std::string html = "<h2>Speed-up at equal error</h2>\n<table><tr><th>scene</th><th>PT over G-PR</th>"
                       "<th>PR over G-PR</th><th>G-PT over G-PR</th></tr>\n";
    for (const SceneCurves& scene : scenes) {
        html += fmt::format("<tr><td>{}</td>", escaped(scene.name));
        for (Method slower : {Method::pt, Method::pr, Method::gpt})
            html += speed_up_cell(scene, slower);
        html += "</tr>\n";
    }
    return html +
           "</table>\n<p class=\"note\">CPU seconds of a method over those of G-PR at equal relMSE, the smallest "
           "that both reach. Each method has the reconstruction with the smallest final error. Times are "
           "interpolated on the log-log curves, never extrapolated. In brackets: 95 % confidence interval from "
           "the seeds. “At least”: the first measurement of G-PR is already below that error.</p>\n";
}

std::string figures_table(const ExperimentOptions& options, const SceneCurves& scene) {
    std::string html =
        "<table><tr><th>method</th><th>spp</th><th>CPU s</th><th>wall s</th><th>relMSE</th>"
        "<th>deviation over seeds</th><th>FLIP</th><th>slope</th><th>efficiency</th><th>tiles</th></tr>\n";
    for (const Curve& curve : scene.curves) {
        const Result& r = last_of(curve);
        html += fmt::format("<tr><td>{}</td><td>{:.4g}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
                            "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            escaped(curve_label(options, curve)), spp_of(r), number(cpu_seconds_of(r)),
                            number(wall_seconds_of(r)), error_text(r), number(error_deviation(r)),
                            number(column_value("flip", r)), number(slope_of(curve)), number(efficiency_of(r)),
                            number(column_value("tile_edge_spectrum", r)));
    }
    return html + "</table>\n";
}

/// Returns the scene's file and a description of its references.
std::string reference_text(const Experiment& experiment, const SceneCurves& scene) {
    std::vector<Result> results;
    for (const Curve& curve : scene.curves)
        results.push_back(last_of(curve));
    const Result& first = results.front();
    return fmt::format("<p class=\"note\">{}. {}</p>\n", escaped(first.file.string()),
                       escaped(describe_references(experiment, first.scene, results)));
}

std::string scene_section(const Experiment& experiment, const SceneCurves& scene) {
    const ExperimentOptions& options = experiment.options();
    return fmt::format("<h2>{}</h2>\n{}{}{}{}{}", escaped(scene.name), reference_text(experiment, scene),
                       to_svg(bench_chart(options, scene)), to_svg(seen_chart(options, scene)),
                       figures_table(options, scene), crops_section(experiment, scene));
}

std::string row(std::string_view name, const std::string& value) {
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
}

std::string settings_section(const Experiment& experiment) {
    const ExperimentOptions& options = experiment.options();
    PictureSettings s = options.settings;
    std::string html = "<h2>Settings and machine</h2>\n<table>\n";
    html += row("program", fmt::format("tessera {}{}", program_identity(),
                                       options.takes_any_build ? ", some runs possibly by another build" : ""));
    html += row("machine", machine_text());
    html += row("written on", today());
    html += row("threads", s.threads > 0 ? std::to_string(s.threads)
                                         : fmt::format("{} (all)", std::thread::hardware_concurrency()));
    html += row("each render", to_string(options.effort));
    html += row("seeds", fmt::format("{} to {}", s.render.seed,
                                     s.render.seed + static_cast<std::uint64_t>(options.seeds) - 1));
    html += row("size", fmt::format("{}x{}", s.size.x, s.size.y));
    html += row("alpha", number(s.reconstruction.alpha));
    for (const Setting& setting : settings_of(s.render))
        html += row(setting.id, setting.text());
    for (const Variation& variation : options.variations) {
        std::string values;
        for (const std::string& value : variation.values)
            values += (values.empty() ? "" : ", ") + value;
        html += row("varied: " + variation.variable.id, values);
    }
    return html + "</table>\n";
}

} // namespace

std::string bench_page(const Experiment& experiment, const std::vector<SceneCurves>& scenes) {
    std::string html = interruption_note();
    html += "<p class=\"note\">relMSE is the mean of (I − r₁)(I − r₂) / (r² + 0.001) over the pixels, where r₁ "
            "and r₂ are the two independent halves of a reference and r is their mean: their noise does not enter "
            "the expectation. The number after ± is its standard error; a smaller error is given as &lt; and "
            "omitted from charts. FLIP is the mean difference that an observer perceives when flipping between "
            "picture and reference, from 0 to 1. Times include rendering and one reconstruction. “Tiles” measures "
            "how visible the tile grid is in the error, as a ratio of spectral power; 1: not visible.</p>\n";
    html += speed_up_section(scenes);
    if (scenes.size() > 1)
        html += to_svg(triangle_chart(experiment.options(), scenes));
    for (const SceneCurves& scene : scenes)
        html += scene_section(experiment, scene);
    return html_page("Error against time", html + settings_section(experiment));
}

} // namespace tessera
