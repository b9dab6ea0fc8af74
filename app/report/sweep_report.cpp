#include "app/cli/opened_scene.h"
#include "app/report/reports.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/core.h>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

using Results = std::vector<Result>;

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

/// An error below its uncertainty is shown as an upper bound.
std::string error_cell(const Result& r) {
    return is_significant(r) ? cell(error_of(r)) : fmt::format("< {}", cell(error_uncertainty(r)));
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

/// Returns a table of error, time and efficiency.
std::string error_table(const ExperimentOptions& options, const Results& results) {
    std::string text = "| scene | method |";
    for (const Variation& variation : options.variations)
        text += fmt::format(" {} |", variation.variable.id);
    text += " spp | relMSE | uncertainty | deviation | CPU s | deviation | efficiency |\n";
    text += rule(9 + options.variations.size(), 2);
    for (const Result& r : results) {
        text += fmt::format("| {} | {} |", r.title(), name_of(r.setup));
        for (const std::string& value : r.setup.values)
            text += fmt::format(" {} |", value_cell(value));
        text += fmt::format(" {} | {} | {} | {} | {} | {} | {} |\n", cell(spp_of(r)), error_cell(r),
                            cell(error_uncertainty(r)), cell(error_deviation(r)), cell(cpu_seconds_of(r)),
                            cell(cpu_seconds_deviation(r)), cell(efficiency_of(r)));
    }
    return text;
}

std::string first_value(const Result& result) {
    return result.setup.values.empty() ? "" : result.setup.values.front();
}

std::string percent(double share) {
    return std::isfinite(share) ? fmt::format("{:.1f}", 100 * share) : "-";
}

/// Returns [Bauszat 2017, table 1], transposed: a row for every scene, method and value of the second variation,
/// a column for every value of the first.
std::string reuse_table(const ExperimentOptions& options, const Results& results) {
    std::vector<std::string> columns;
    std::vector<std::pair<std::string, std::string>> lines;
    for (const Result& r : results) {
        if (!std::isfinite(reused_fraction(r)))
            continue; // no path reuse
        const std::pair line(r.title(), line_label(options, r));
        if (std::find(columns.begin(), columns.end(), first_value(r)) == columns.end())
            columns.push_back(first_value(r));
        if (std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(line);
    }
    std::string text = "| scene | method |";
    for (const std::string& column : columns)
        text += options.variations.empty()
                    ? " all |"
                    : fmt::format(" {} {} |", options.variations.front().variable.id, value_cell(column));
    text += "\n" + rule(2 + columns.size(), 2);
    for (const auto& [scene, label] : lines) {
        text += fmt::format("| {} | {} |", scene, label);
        for (const std::string& column : columns) {
            const auto found = std::find_if(results.begin(), results.end(), [&](const Result& r) {
                return r.title() == scene && line_label(options, r) == label && first_value(r) == column;
            });
            text += found == results.end() ? " |"
                                           : fmt::format(" {} / {} |", percent(skipped_fraction(*found)),
                                                         percent(reused_fraction(*found)));
        }
        text += "\n";
    }
    return text;
}

bool has_tiles(const Result& r) {
    return std::any_of(r.runs.begin(), r.runs.end(), [](const Measurement& m) { return m.tiles.has_value(); });
}

/// Returns a table of the visibility of the tile grid in the error.
std::string tile_table(const ExperimentOptions& options, const Results& results) {
    std::string text = "| scene | method |";
    for (const Variation& variation : options.variations)
        text += fmt::format(" {} |", variation.variable.id);
    text += " error | edges | edge ratio |\n" + rule(5 + options.variations.size(), 2);
    for (const Result& r : results) {
        if (!has_tiles(r))
            continue;
        text += fmt::format("| {} | {} |", r.title(), name_of(r.setup));
        for (const std::string& value : r.setup.values)
            text += fmt::format(" {} |", value_cell(value));
        for (const char* id : {"tile_error_spectrum", "tile_edge_spectrum", "tile_edge_ratio"})
            text += fmt::format(" {} |", cell(column_value(id, r)));
        text += "\n";
    }
    return text;
}

/// Returns a line for each scene with a description of its references.
std::string reference_list(const Experiment& experiment, const Results& results) {
    std::string text;
    for (const MeasuredScene& scene : experiment.scenes()) {
        Results of_scene;
        std::ranges::copy_if(results, std::back_inserter(of_scene),
                             [&](const Result& r) { return r.scene == scene.name(); });
        if (const std::string words = describe_references(experiment, scene.name(), of_scene); !words.empty())
            text += fmt::format("- {}: {}\n", scene.name(), words);
    }
    return text;
}

std::string markdown(const Experiment& experiment, const Results& results) {
    const ExperimentOptions& options = experiment.options();
    const glm::ivec2 size = options.settings.size;
    return fmt::format("# Sweep\n\n"
                       "{}x{} pixels, {}, {} seed{}.\n\n"
                       "## Error, time and efficiency\n\n"
                       "relMSE is measured against two independent halves of a reference, whose noise does not "
                       "enter the expectation. Its uncertainty is the standard error of one render, from the "
                       "differences between its pieces, or that of the mean over the seeds, if larger. CPU "
                       "seconds include rendering and reconstruction. Values are means over the seeds, with their "
                       "standard deviations. Efficiency is 1 / (relMSE × CPU seconds).\n\n{}\n"
                       "## References\n\n{}\n"
                       "## Base paths skipped by Russian roulette / reused\n\n"
                       "In per cent of the base paths of all sampling sets; the rest carry no light.\n\n{}\n"
                       "## Tiles in the error\n\n"
                       "Error, edges: power at the multiples of the tile frequency over that at neighbouring "
                       "frequencies, of the error and of its squared differences between neighbouring pixels "
                       "(means over columns and rows). Edge ratio: largest squared difference by position in the "
                       "tile over the others. 1: the grid is not visible.\n\n{}",
                       size.x, size.y, to_string(options.effort), options.seeds, options.seeds > 1 ? "s" : "",
                       error_table(options, results), reference_list(experiment, results),
                       reuse_table(options, results), tile_table(options, results));
}

} // namespace

void write_sweep(const Experiment& experiment, const Results& results) {
    const ExperimentOptions& options = experiment.options();
    write_text(options.output / "sweep.csv", to_csv(options, results));
    write_text(options.output / "sweep.json", to_json(options, results));
    write_text(options.output / "sweep.md", markdown(experiment, results));
    std::map<std::string, Results> scenes;
    for (const Result& result : results)
        scenes[result.title()].push_back(result);
    for (const auto& [scene, of_scene] : scenes)
        write_text(options.output / fmt::format("sweep-{}.svg", file_name(scene)),
                   to_svg(sweep_chart(options, of_scene)));
}

} // namespace tessera
