#include "app/report/stability_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace tessera {

const ReferenceImage& reference_of(const StabilityCase& c) {
    return c.experiment->scenes().front().reference(c.options->settings);
}

double level_of(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases) {
    const auto setups = setups_of(suite.settings, suite.methods, suite.norms, suite.variations).size();
    return 0.01 / static_cast<double>(2 * setups * cases.size());
}

namespace {

/// Returns the rows of a case.
std::vector<StabilityRow> rows_of(const StabilityCase& c, double level) {
    std::vector<Result> results = c.experiment->results();
    std::erase_if(results, [](const Result& r) { return r.runs.size() < 2; });
    if (results.empty())
        return {};
    const ReferenceImage& reference = reference_of(c);
    const ReferenceNoise noise = measure_reference_noise(reference.halves[0], reference.halves[1]);
    std::vector<StabilityRow> rows;
    for (const Result& result : results) {
        const auto pt = std::find_if(results.begin(), results.end(), [&](const Result& r) {
            return r.setup.settings.render.method == Method::pt && r.machine == result.machine;
        });
        if (pt == results.end())
            continue;
        const Findings found = find(result, *pt, noise);
        rows.push_back({&c, result, found, judge(found, find(*pt, *pt, noise), level)});
    }
    return rows;
}

} // namespace

std::vector<StabilityRow> rows_of(const std::vector<StabilityCase>& cases, double level) {
    std::vector<StabilityRow> all;
    for (const StabilityCase& c : cases)
        for (StabilityRow& row : rows_of(c, level))
            all.push_back(std::move(row));
    return all;
}

std::string name_of(const Result& result) {
    return name_of(result.setup) + (result.machine.empty() ? "" : " (" + result.machine + ")");
}

std::string to_csv(const std::vector<StabilityRow>& rows) {
    std::string text =
        "scene,method,recon,verdict,cause,seeds,spp,cpu_seconds,energy,energy_error,energy_sigmas,"
        "squared_bias,squared_bias_error,squared_bias_sigmas,relmse,relmse_error,flip,factor,factor_low,"
        "factor_high,spike,worst,worst_x,worst_y,worst_share,tile_edges,tile_edges_error,tone_mapped,tenfold,"
        "halo_energy,halo_peak,bad_pixels,refused_samples,machine\n";
    for (const StabilityRow& row : rows) {
        const Findings& f = row.findings;
        const PictureSettings& s = row.result.setup.settings;
        text += fmt::format("{},{},{},{},{},{}", csv_cell(row.of->name()), short_name(s.render.method),
                            to_string(s.reconstruction.norm), to_string(row.verdict.kind),
                            csv_cell(row.verdict.cause), row.result.runs.size());
        for (double value : {spp_of(row.result),
                             cpu_seconds_of(row.result),
                             f.energy.value,
                             f.energy.error,
                             f.energy.sigmas,
                             f.squared_bias.value,
                             f.squared_bias.error,
                             f.squared_bias.sigmas,
                             f.error,
                             f.error_error,
                             column_value("flip", row.result),
                             f.factor,
                             f.low,
                             f.high,
                             f.spike,
                             f.worst,
                             double(f.worst_pixel.x),
                             double(f.worst_pixel.y),
                             f.worst_fraction,
                             f.tile_edges,
                             f.tile_edges_error,
                             f.tone_mapped,
                             f.tenfold,
                             f.halo_energy,
                             f.halo_peak})
            text += std::isfinite(value) ? fmt::format(",{:.7g}", value) : ",";
        text += fmt::format(",{},{},{}\n", f.bad_pixels, f.refused, csv_cell(row.result.machine));
    }
    return text;
}

} // namespace tessera
