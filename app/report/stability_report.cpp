#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/experiment/speed_up.h"
#include "app/report/reports.h"
#include "render/io/exr.h"
#include "render/io/plain_images.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// The names in the cells, each once, in the order in which they come.
std::vector<std::string> names(const std::vector<OverviewCell>& cells, std::string OverviewCell::*member) {
    std::vector<std::string> names;
    for (const OverviewCell& cell : cells)
        if (std::find(names.begin(), names.end(), cell.*member) == names.end())
            names.push_back(cell.*member);
    return names;
}

std::string text_of(const OverviewCell& cell) {
    const std::string ratio = std::isfinite(cell.factor) ? fmt::format(" {:.3g}", cell.factor) : "";
    if (cell.verdict == Verdict::Kind::ok)
        return "ok" + ratio;
    if (cell.verdict == Verdict::Kind::worse)
        return fmt::format("**worse{}**", ratio);
    return fmt::format("**{}**{}", to_string(cell.verdict), ratio);
}

} // namespace

std::string overview(const std::vector<OverviewCell>& cells) {
    const std::vector<std::string> setups = names(cells, &OverviewCell::setup);
    std::string text = "| scene |", rule = "| --- |";
    for (const std::string& setup : setups) {
        text += fmt::format(" {} |", setup);
        rule += " --- |";
    }
    text += "\n" + rule + "\n";
    for (const std::string& scene : names(cells, &OverviewCell::scene)) {
        text += fmt::format("| [{0}](#{0}) |", scene);
        for (const std::string& setup : setups) {
            const auto cell = std::find_if(cells.begin(), cells.end(), [&](const OverviewCell& c) {
                return c.scene == scene && c.setup == setup;
            });
            text += cell == cells.end() ? " |" : fmt::format(" {} |", text_of(*cell));
        }
        text += "\n";
    }
    return text;
}

std::string anchor(const std::string& scene) {
    return fmt::format("<a id=\"{}\"></a>", scene);
}

namespace {

/// What was found of one setup on one scene.
struct Row {
    const StabilityCase* of;
    Result result;
    Findings findings;
    Verdict verdict;
};

const ReferenceImage& reference_of(const StabilityCase& c) {
    return c.experiment->scenes().front().reference(c.options->settings);
}

/// The suite is to call a mean wrong that is not once in a hundred times, all its tests together [Bonferroni]:
/// energy and bias of each setup.
double level_of(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases) {
    const auto setups = setups_of(suite.settings, suite.methods, suite.norms, suite.variations).size();
    return 0.01 / static_cast<double>(2 * setups * cases.size());
}

/// The rows of a case, of setups that have two runs, as PT has on the same kind of machine.
std::vector<Row> rows_of(const StabilityCase& c, double level) {
    std::vector<Result> results = c.experiment->results();
    std::erase_if(results, [](const Result& r) { return r.runs.size() < 2; });
    if (results.empty())
        return {};
    const ReferenceImage& reference = reference_of(c);
    const ReferenceNoise noise = measure_reference_noise(reference.halves[0], reference.halves[1]);
    std::vector<Row> rows;
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

std::vector<Row> rows_of(const std::vector<StabilityCase>& cases, double level) {
    std::vector<Row> all;
    for (const StabilityCase& c : cases)
        for (Row& row : rows_of(c, level))
            all.push_back(std::move(row));
    return all;
}

/// The image brighter by that factor, and in pixels twice as large.
RgbImage shown(const RgbImage& image, float factor) {
    RgbImage large(2 * image.width(), 2 * image.height());
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x)
            large(x, y) = factor * image(x / 2, y / 2);
    return large;
}

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string percent(const Deviation& d) {
    return fmt::format("{:+.2f} ± {:.2f}", 100 * d.value, 100 * d.error);
}

/// The cell of a squared deviation; what is below nothing is noise.
std::string bias_cell(const Deviation& d) {
    return fmt::format("{:.2f} (< {:.2f})", 100 * std::sqrt(std::max(0.0, d.value)),
                       100 * std::sqrt(std::max(0.0, d.value + 2 * d.error)));
}

std::string verdict_cell(const Row& row) {
    const std::string word = to_string(row.verdict.kind);
    return row.verdict.cause.empty() ? word : fmt::format("**{}**: {}", word, row.verdict.cause);
}

/// What the rows call a setup, and the kind of machine where results are told apart by it.
std::string name_of(const Result& result) {
    return name_of(result.setup) + (result.machine.empty() ? "" : " (" + result.machine + ")");
}

std::string csv(const std::vector<Row>& rows) {
    std::string text =
        "scene,method,recon,verdict,cause,seeds,spp,cpu_seconds,energy,energy_error,energy_sigmas,"
        "squared_bias,squared_bias_error,squared_bias_sigmas,relmse,relmse_error,factor,factor_low,"
        "factor_high,spike,worst,worst_x,worst_y,worst_share,tile_edges,tile_edges_error,tone_mapped,tenfold,"
        "halo_energy,halo_peak,bad_pixels,refused_samples,machine\n";
    for (const Row& row : rows) {
        const Findings& f = row.findings;
        const PictureSettings& s = row.result.setup.settings;
        text += fmt::format("{},{},{},{},\"{}\",{}", row.of->name(), short_name(s.render.method),
                            to_string(s.reconstruction.norm), to_string(row.verdict.kind), row.verdict.cause,
                            row.result.runs.size());
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
                             f.factor,
                             f.low,
                             f.high,
                             f.spike,
                             f.worst,
                             double(f.worst_pixel.x),
                             double(f.worst_pixel.y),
                             f.worst_share,
                             f.tile_edges,
                             f.tile_edges_error,
                             f.tone_mapped,
                             f.tenfold,
                             f.halo_energy,
                             f.halo_peak})
            text += std::isfinite(value) ? fmt::format(",{:.7g}", value) : ",";
        text += fmt::format(",{},{},\"{}\"\n", f.bad_pixels, f.refused, row.result.machine);
    }
    return text;
}

std::vector<OverviewCell> cells_of(const std::vector<Row>& rows) {
    std::vector<OverviewCell> cells;
    for (const Row& row : rows)
        cells.push_back({row.of->name(), name_of(row.result), row.verdict.kind, row.findings.factor});
    return cells;
}

std::string table(const std::vector<Row>& rows) {
    std::string text =
        "| | verdict | error at equal time / PT's | energy % | bias % | spike | worst pixel | worst pixels' "
        "share | off tenfold % | tone-mapped | halo | tile edges | relMSE | spp |\n"
        "| --- | --- | --- | --- | --- | ---: | --- | ---: | ---: | ---: | --- | ---: | --- | ---: |\n";
    for (const Row& row : rows) {
        const Findings& f = row.findings;
        text += fmt::format("| {} | {} | {} ({} to {}) | {} | {} | {:.3g} | {:.3g} at {},{} | {:.0f} % | {:.3g} | "
                            "{:.3g} | {} ({}) | "
                            "{} | {:.3g} ± {:.1g} | {:.4g} |\n",
                            name_of(row.result), verdict_cell(row), cell(f.factor), cell(f.low), cell(f.high),
                            percent(f.energy), bias_cell(f.squared_bias), f.spike, f.worst, f.worst_pixel.x,
                            f.worst_pixel.y, 100 * f.worst_share, 100 * f.tenfold, 1000 * f.tone_mapped,
                            cell(f.halo_energy), cell(f.halo_peak), cell(f.tile_edges), f.error, f.error_error,
                            spp_of(row.result));
    }
    return text;
}

std::string section(const StabilityCase& c, const std::vector<Row>& rows) {
    const FloorFreeError error = error_of(reference_of(c));
    const ExperimentOptions& options = *c.options;
    const glm::ivec2 size = options.settings.size;
    return fmt::format(
        "\n{}\n\n## {}\n\n{}\n\n{}x{} pixels, {}, {} seeds. Reference: relMSE of its own {:.2g} ± {:.1g}. "
        "![{}]({}.png)\n\n{}",
        anchor(c.name()), c.name(), c.scene.fails.empty() ? "" : "Known to fail: " + c.scene.fails, size.x, size.y,
        to_string(options.effort), options.seeds, error.relative_mse, error.standard_error, c.name(), c.name(),
        table(rows));
}

std::string introduction(const ExperimentOptions& suite, double level) {
    const glm::ivec2 size = suite.settings.size;
    return fmt::format(
        "# Stability\n\n"
        "{}x{} pixels, {} each, {} seeds, unless a scene says what it needs; {}. References are by path "
        "tracing.\n\n"
        "- **fails**: not finite; or the mean over the seeds is not the reference's, by more than {:.1f} sigma: "
        "of "
        "the energy (mean luminance), or of the squared bias of pieces of 8x8 pixels. Where a method is linear in "
        "its samples (none, l2), nothing but rounding is tolerated; of other reconstructions, 2 % of the energy "
        "and 10 % "
        "RMS of the pieces.\n"
        "- **worse**: relMSE times CPU seconds (reconstruction included) is more than PT's, and so is the low end "
        "of its interval of 95 %, from how seeds differ.\n"
        "- **undecided**: PT itself differs from the reference, which then lacks rare light.\n"
        "- Sigmas are corrected for all tests of the suite: one suite in a hundred calls a mean wrong that is not "
        "(level {:.1e} each). Intervals are not: of forty that hold 1, one is called worse.\n"
        "- Radiances are in units of the reference's mean luminance. spike: 99.99th percentile of the pixels' "
        "relative errors, all seeds together. bias: root of the squared bias, without noise, and its upper end (2 "
        "standard errors). worst pixels' share: of relMSE, what about 1 in 1000 pixels (16 at the least) have. "
        "off tenfold: pixels of more than ten times the reference's luminance, or less than a tenth. tone-mapped: "
        "1000 times the mean squared error of x / (1 + x), which no spike rules. halo: what the brightest spike "
        "puts "
        "outside of its tile, over its own energy, and the largest change of a pixel there, over its brightness "
        "(a "
        "ring or a blob; spread light has much of the former and little of the latter). tile edges: spectrum of "
        "squared steps at the tile frequency, 1 where no grid shows.\n\n",
        size.x, size.y, to_string(suite.effort), suite.seeds, cpu_model(), sigmas(level), level);
}

} // namespace

void write_stability(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases) {
    const double level = level_of(suite, cases);
    const std::vector<Row> rows = rows_of(cases, level);
    std::string text = introduction(suite, level) + overview(cells_of(rows));
    for (const StabilityCase& c : cases) {
        std::vector<Row> of_case;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_case),
                     [&](const Row& r) { return r.of == &c; });
        if (!of_case.empty())
            text += section(c, of_case);
    }
    write_text(suite.output / "stability.md", text);
    write_text(suite.output / "stability.csv", csv(rows));
}

void write_sheet(const ExperimentOptions& suite, const StabilityCase& c) {
    const std::vector<Result> results = c.experiment->results();
    if (results.empty())
        return;
    const RgbImage& reference = reference_of(c).mean;
    const float exposure = usual_exposure(reference);
    std::vector<LabelledPicture> pictures = {{"reference", reference}};
    for (const Result& result : results) {
        const std::filesystem::path file = c.experiment->image_file(c.name(), result.setup);
        if (std::filesystem::exists(file)) {
            const ExrFile exr = read_exr(file, {}, {""});
            pictures.push_back({name_of(result.setup), require_layer(exr, "", file)});
        }
    }
    for (LabelledPicture& picture : pictures)
        picture.image = shown(picture.image, std::exp2(exposure));
    write_png(suite.output / (c.name() + ".png"), picture_sheet(pictures, 4));
}

} // namespace tessera
