#include "app/cli/terminal.h"
#include "app/report/reports.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <thread>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::ordered_json;

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos)
        return text;
    std::string quoted = "\"";
    for (char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

namespace {

/// Returns the value; null for infinities and NaN, which JSON lacks.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// Returns the kinds of machines of the result's runs.
std::string machines_of(const Result& result) {
    std::set<std::string> kinds;
    for (const Measurement& run : result.runs)
        kinds.insert(run.machine);
    return fmt::format("{}", fmt::join(kinds, "; "));
}

/// Returns the value of a variation, as a number if it is one; null if it has no effect.
ordered_json value_json(const Variation& variation, const std::string& value) {
    if (value.empty())
        return nullptr;
    PictureSettings settings;
    variation.variable.set_text(settings, value);
    const std::optional<double> number = variation.variable.number(settings);
    return number && variation.variable.id != "size" ? ordered_json(*number) : ordered_json(value);
}

ordered_json result_json(const ExperimentOptions& options, const Result& result) {
    const PictureSettings& s = result.setup.settings;
    const SceneSource source{result.file, {}, {}};
    ordered_json row{{"scene", result.scene},
                     {"method", short_name(s.render.method)},
                     {"recon", to_string(s.reconstruction.norm)}};
    for (std::size_t i = 0; i < options.variations.size(); ++i)
        row[options.variations[i].variable.id] = value_json(options.variations[i], result.setup.values[i]);
    row["effort"] = to_string(effort_of(options, result));
    for (const ResultColumn& column : result_columns())
        row[std::string(column.id)] = number(column.value(result));
    row["machine"] = machines_of(result);
    row["settings"] = settings_json(source, s.render, s.size, result.runs.front().spp, s.reconstruction);
    row["runs"] = ordered_json::array();
    for (const Measurement& run : result.runs)
        row["runs"].push_back(to_json(run));
    return row;
}

bool is_gpr(const Curve& curve) {
    return last_of(curve).setup.settings.render.method == Method::gpr;
}

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", value) : "";
}

std::string_view kind_name(SpeedUp::Kind kind) {
    constexpr std::string_view names[] = {"out of range", "measured", "at least", "at most"};
    return names[static_cast<int>(kind)];
}

} // namespace

std::string to_csv(const ExperimentOptions& options, const std::vector<Result>& results) {
    std::string text = "scene,method,recon";
    for (const Variation& variation : options.variations)
        text += fmt::format(",{}", variation.variable.id);
    text += ",effort";
    for (const ResultColumn& column : result_columns())
        text += fmt::format(",{}", column.id);
    text += ",machine";
    for (const Result& result : results) {
        text += fmt::format("\n{},{},{}", csv_cell(result.scene), short_name(result.setup.settings.render.method),
                            to_string(result.setup.settings.reconstruction.norm));
        for (const std::string& value : result.setup.values)
            text += "," + csv_cell(value);
        text += "," + to_string(effort_of(options, result));
        for (const ResultColumn& column : result_columns()) {
            const double value = column.value(result);
            text += std::isfinite(value) ? fmt::format(",{:.7g}", value) : ",";
        }
        text += "," + csv_cell(machines_of(result));
    }
    return text + "\n";
}

std::string to_json(const ExperimentOptions& options, const std::vector<Result>& results) {
    ordered_json scenes = ordered_json::array(), rows = ordered_json::array(), varied = ordered_json::object();
    for (const std::filesystem::path& scene : options.scenes)
        scenes.push_back(scene.string());
    for (const Variation& variation : options.variations)
        varied[variation.variable.id] = variation.values;
    for (const Result& result : results)
        rows.push_back(result_json(options, result));
    const ordered_json out{{"version", TESSERA_VERSION},
                           {"program", program_identity()},
                           {"machine",
                            {{"cpu", cpu_model()},
                             {"hardware_threads", std::thread::hardware_concurrency()},
                             {"threads", options.settings.threads}}},
                           {"interrupted", interrupted()},
                           {"scenes", scenes},
                           {"varied", varied},
                           {"effort", to_string(options.effort)},
                           {"reference_folder", options.references.string()},
                           {"results", rows}};
    return to_text(out, 2) + "\n";
}

Effort effort_of(const ExperimentOptions& options, const Result& result) {
    return {std::ldexp(options.effort.amount, -result.halvings), options.effort.unit};
}

std::string file_name(const std::string& title) {
    std::string name = title;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

std::string line_label(const ExperimentOptions& options, const Result& result) {
    const PictureSettings& s = result.setup.settings;
    std::string label(short_name(s.render.method));
    const bool has_norm = has_gradients(s.render.method) || s.reconstruction.norm != Norm::none;
    if (options.norms.size() > 1 && has_norm)
        label += fmt::format(" {}", to_string(s.reconstruction.norm));
    for (std::size_t i = 1; i < options.variations.size(); ++i)
        if (!result.setup.values[i].empty())
            label += fmt::format(", {} {}", options.variations[i].variable.id, result.setup.values[i]);
    return label;
}

std::string speed_up_csv(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes) {
    std::string text = "scene,slower,faster,kind,speed_up,low_95,high_95,relmse\n";
    for (const SceneCurves& scene : scenes)
        for (const Curve& slower : scene.curves)
            for (const Curve& faster : scene.curves) {
                if (is_gpr(slower) || !is_gpr(faster))
                    continue;
                const SpeedUp s = speed_up(slower, faster);
                text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_cell(scene.name),
                                    csv_cell(curve_label(options, slower)), csv_cell(curve_label(options, faster)),
                                    kind_name(s.kind), cell(s.factor), cell(s.low), cell(s.high), cell(s.error));
            }
    return text;
}

} // namespace tessera
