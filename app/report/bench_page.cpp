#include "app/cli/terminal.h"
#include "app/report/reports.h"
#include "embedded/compare_script.h"
#include "recon/enumeration.h"
#include "render/io/plain_images.h"
#include "render/settings/settings_table.h"

#include <cmath>
#include <thread>

#include <fmt/core.h>

namespace tessera {

namespace {

/// The bytes in base 64 [RFC 4648, 4].
std::string base64(const std::vector<char>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

} // namespace

std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes) {
    return fmt::format(R"(<img width="{}" height="{}" {} src="data:image/png;base64,{}">)", image.width(),
                       image.height(), attributes, base64(encode_png(image, exposure)));
}

namespace {

constexpr const char* style = R"(
body { font: 15px/1.45 Inter, "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; max-width: 1120px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.25em; margin-top: 2.2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2em 0.7em; border-bottom: 1px solid #e4e4e4; text-align: right;
         white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } th { font-weight: 600; }
.note { color: #666; max-width: 52em; } svg { max-width: 100%; height: auto; }
.crops { display: flex; flex-wrap: wrap; gap: 10px; } figure { margin: 0; }
figcaption { font-size: 12px; color: #444; } .crops img { image-rendering: pixelated; display: block; }
.compare canvas { width: 100%; display: block; background: #000; cursor: crosshair; }
.compare output { font: 12px monospace; color: #444; white-space: pre; display: block; overflow: hidden; }
.compare button { margin-right: 2px; } .compare button.on { background: #008c74; color: #fff; }
code { background: #f4f4f4; padding: 0 0.2em; }
)";

std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

/// An error below its uncertainty is none that could be told.
std::string error_text(const Result& r) {
    return is_certain(r) ? fmt::format("{:.3g} ± {:.1g}", error_of(r), error_uncertainty(r))
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
           "</table>\n<p class=\"note\">CPU seconds of the one method over those of G-PR to come to the same "
           "relMSE, the least that both come to, each with the reconstruction that has the least error at the "
           "end; interpolated on the log-log curves, never extrapolated. In brackets: 95 % confidence from "
           "the seeds. “At least”: G-PR was below that error when it was first measured.</p>\n";
}

std::string figures_table(const ExperimentOptions& options, const SceneCurves& scene) {
    std::string html = "<table><tr><th>method</th><th>spp</th><th>CPU s</th><th>wall s</th><th>relMSE</th>"
                       "<th>deviation of seeds</th><th>slope</th><th>efficiency</th><th>tiles</th></tr>\n";
    for (const Curve& curve : scene.curves) {
        const Result& r = last_of(curve);
        html += fmt::format("<tr><td>{}</td><td>{:.4g}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
                            "<td>{}</td><td>{}</td></tr>\n",
                            escaped(curve_label(options, curve)), spp_of(r), number(cpu_seconds_of(r)),
                            number(wall_seconds_of(r)), error_text(r), number(error_deviation(r)),
                            number(slope_of(curve)), number(efficiency_of(r)),
                            number(column_value("tile_edge_spectrum", r)));
    }
    return html + "</table>\n";
}

std::string reference_text(const Experiment& experiment, const std::string& scene) {
    std::string html;
    for (const MeasuredScene& measured : experiment.scenes()) {
        if (measured.name() != scene)
            continue;
        html += fmt::format("<p class=\"note\">{}", escaped(measured.source().file.string()));
        for (const FolderReference* reference : measured.references()) {
            if (!reference->is_complete())
                continue;
            const FloorFreeError error = error_of(reference->image());
            html += fmt::format("; reference <code>{}</code>, itself at relMSE {:.2g}",
                                escaped(reference->path().filename().string()), error.relative_mse);
        }
        html += "</p>\n";
    }
    return html;
}

std::string scene_section(const Experiment& experiment, const SceneCurves& scene) {
    const ExperimentOptions& options = experiment.options();
    return fmt::format("<h2>{}</h2>\n{}{}{}{}", escaped(scene.name),
                       reference_text(experiment, last_of(scene.curves.front()).scene),
                       to_svg(bench_chart(options, scene)), figures_table(options, scene),
                       crops_section(experiment, scene));
}

std::string row(std::string_view name, const std::string& value) {
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
}

std::string settings_section(const Experiment& experiment) {
    const ExperimentOptions& options = experiment.options();
    PictureSettings s = options.settings;
    std::string html = "<h2>Settings and machine</h2>\n<table>\n";
    html += row("program", fmt::format("tessera {}{}", program_identity(),
                                       options.takes_any_build ? ", some runs maybe by another build" : ""));
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
    std::string html = fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                                   "<title>Tessera: error against time</title><style>{}</style></head><body>\n"
                                   "<h1>Error against time</h1>\n",
                                   style);
    if (interrupted())
        html += "<p><b>Not complete: it was interrupted.</b> The same command goes on.</p>\n";
    html +=
        "<p class=\"note\">relMSE is the mean of (I − r₁)(I − r₂) / (r² + 0.001) over the two halves of a "
        "reference, so that their noise does not count. After ± stands its uncertainty; an error below that is "
        "given as &lt; and is in no chart. Times are of rendering and one reconstruction. “Tiles” is how much the "
        "grid of tiles shows in the error, as a ratio of spectral power; 1: it does not.</p>\n";
    html += speed_up_section(scenes);
    if (scenes.size() > 1)
        html += to_svg(triangle_chart(experiment.options(), scenes));
    for (const SceneCurves& scene : scenes)
        html += scene_section(experiment, scene);
    return fmt::format("{}{}<script>\n{}</script></body></html>\n", html, settings_section(experiment),
                       compare_script);
}

} // namespace tessera
