#include "app/sweep_report.h"

#include "app/machine.h"
#include "app/output_file.h"
#include "app/stats.h"
#include "app/sweep_chart.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::ordered_json;

namespace {

using Results = std::vector<SweepResult>;

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos)
        return text;
    std::string quoted = "\"";
    for (char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csv(const SweepOptions& options, const Results& results) {
    std::string text = "scene,method";
    for (const Variation& variation : options.variations)
        text += fmt::format(",{}", variation.setting->id);
    for (const SweepFigure& figure : sweep_figures())
        text += fmt::format(",{}", figure.id);
    for (const SweepResult& result : results) {
        text += fmt::format("\n{},{}", csv_cell(result.scene), short_name(result.point.settings.method));
        for (const std::string& value : result.point.values)
            text += "," + csv_cell(value);
        for (const SweepFigure& figure : sweep_figures()) {
            const double value = figure.value(result);
            text += std::isfinite(value) ? fmt::format(",{:.7g}", value) : ",";
        }
    }
    return text + "\n";
}

/// JSON knows no infinities, and no "not a number": null.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json run_json(const SweepRun& run) {
    return {{"seed", run.seed},
            {"spp", run.spp},
            {"cpu_seconds", run.cpu_seconds},
            {"wall_seconds", run.wall_seconds},
            {"relmse", number(run.relative_mse)},
            {"relmse_floor_free", number(run.floor_free.relative_mse)},
            {"relmse_floor_free_standard_error", number(run.floor_free.standard_error)}};
}

ordered_json result_json(const SweepOptions& options, const SweepResult& result) {
    const SceneSource source{result.file, {}, {}};
    const nlohmann::json settings = settings_json(source, result.point.settings, options.size,
                                                  result.runs.front().spp, options.reconstruction.alpha);
    ordered_json row{{"scene", result.scene}, {"method", short_name(result.point.settings.method)}};
    for (std::size_t i = 0; i < options.variations.size(); ++i) {
        const std::string id(options.variations[i].setting->id);
        row[id] = result.point.values[i].empty() ? nlohmann::json() : settings.at(id);
    }
    for (const SweepFigure& figure : sweep_figures())
        row[std::string(figure.id)] = number(figure.value(result));
    row["settings"] = settings;
    row["runs"] = ordered_json::array();
    for (const SweepRun& run : result.runs)
        row["runs"].push_back(run_json(run));
    return row;
}

std::string json(const SweepOptions& options, const Results& results, int threads, bool is_interrupted) {
    ordered_json scenes = ordered_json::array(), rows = ordered_json::array(), varied = ordered_json::object();
    for (const std::filesystem::path& scene : options.scenes)
        scenes.push_back(scene.string());
    for (const Variation& variation : options.variations)
        varied[std::string(variation.setting->id)] = variation.values;
    for (const SweepResult& result : results)
        rows.push_back(result_json(options, result));
    const ordered_json out{
        {"version", TESSERA_VERSION},
        {"machine",
         {{"cpu", cpu_model()}, {"hardware_threads", std::thread::hardware_concurrency()}, {"threads", threads}}},
        {"interrupted", is_interrupted},
        {"scenes", scenes},
        {"varied", varied},
        {"reconstruction", to_string(options.reconstruction.norm)},
        {"reference_folder", options.references.string()},
        {"results", rows}};
    return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

std::string value_cell(const std::string& value) {
    return value.empty() ? "any" : value;
}

std::string rule(std::size_t columns, std::size_t left) {
    std::string text = "|";
    for (std::size_t i = 0; i < columns; ++i)
        text += i < left ? " --- |" : " ---: |";
    return text + "\n";
}

/// Error, time and efficiency by value.
std::string error_table(const SweepOptions& options, const Results& results) {
    std::string text = "| scene | method |";
    for (const Variation& variation : options.variations)
        text += fmt::format(" {} |", variation.setting->id);
    text += " spp | relMSE | standard error | deviation | CPU s | deviation | efficiency |\n";
    text += rule(9 + options.variations.size(), 2);
    for (const SweepResult& r : results) {
        text += fmt::format("| {} | {} |", r.scene, short_name(r.point.settings.method));
        for (const std::string& value : r.point.values)
            text += fmt::format(" {} |", value_cell(value));
        text += fmt::format(" {} | {} | {} | {} | {} | {} | {} |\n", cell(sweep_figures().front().value(r)),
                            cell(error_of(r)), cell(error_standard_error(r)), cell(error_deviation(r)),
                            cell(cpu_seconds_of(r)), cell(cpu_seconds_deviation(r)), cell(efficiency_of(r)));
    }
    return text;
}

std::string first_value(const SweepResult& result) {
    return result.point.values.empty() ? "" : result.point.values.front();
}

std::string percent(double share) {
    return std::isfinite(share) ? fmt::format("{:.1f}", 100 * share) : "-";
}

/// [Bauszat 2017, table 1], transposed: a line for every scene, method and value of the second variation, a column
/// for every value of the first.
std::string reuse_table(const SweepOptions& options, const Results& results) {
    std::vector<std::string> columns;
    std::vector<std::pair<std::string, std::string>> lines;
    for (const SweepResult& r : results) {
        if (!std::isfinite(reused_share(r)))
            continue; // a method that shares nothing
        const std::pair line(r.scene, line_label(options, r));
        if (std::find(columns.begin(), columns.end(), first_value(r)) == columns.end())
            columns.push_back(first_value(r));
        if (std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(line);
    }
    std::string text = "| scene | method |";
    for (const std::string& column : columns)
        text += options.variations.empty()
                    ? " all |"
                    : fmt::format(" {} {} |", options.variations.front().setting->id, value_cell(column));
    text += "\n" + rule(2 + columns.size(), 2);
    for (const auto& [scene, label] : lines) {
        text += fmt::format("| {} | {} |", scene, label);
        for (const std::string& column : columns) {
            const auto found = std::find_if(results.begin(), results.end(), [&](const SweepResult& r) {
                return r.scene == scene && line_label(options, r) == label && first_value(r) == column;
            });
            text += found == results.end()
                        ? " |"
                        : fmt::format(" {} / {} |", percent(skipped_share(*found)), percent(reused_share(*found)));
        }
        text += "\n";
    }
    return text;
}

std::string markdown(const SweepOptions& options, const Results& results) {
    return fmt::format(
        "# Sweep\n\n"
        "{}x{} pixels, {} seed{}, reconstruction {}.\n\n"
        "## Error, time and efficiency\n\n"
        "relMSE without the references' noise, with its standard error (of one render, from how its "
        "blocks differ), CPU seconds of rendering, means over the seeds and their standard "
        "deviations. Efficiency is 1 / (relMSE × CPU seconds).\n\n{}\n"
        "## Base paths skipped by the roulette / reused\n\n"
        "In per cent of the base paths that a gradient could have from its tile; the rest carry "
        "nothing that could be reused.\n\n{}",
        options.size.x, options.size.y, options.seeds, options.seeds > 1 ? "s" : "",
        to_string(options.reconstruction.norm), error_table(options, results), reuse_table(options, results));
}

} // namespace

void write_sweep(const SweepOptions& options, const Results& all, int threads, bool is_interrupted) {
    Results results, last_scene;
    for (const SweepResult& result : all) {
        if (result.runs.empty())
            continue;
        if (results.empty() || result.scene != results.back().scene)
            last_scene.clear();
        results.push_back(result);
        last_scene.push_back(result);
    }
    write_text(options.output / "sweep.csv", csv(options, results));
    write_text(options.output / "sweep.json", json(options, results, threads, is_interrupted));
    write_text(options.output / "sweep.md", markdown(options, results));
    if (!last_scene.empty())
        write_text(options.output / fmt::format("sweep-{}.svg", last_scene.front().scene),
                   to_svg(sweep_chart(options, last_scene)));
}

} // namespace tessera
