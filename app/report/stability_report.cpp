#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/experiment/speed_up.h"
#include "app/report/page.h"
#include "app/report/reports.h"
#include "app/report/stability_rows.h"
#include "render/io/plain_images.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Returns the distinct names in the cells, in order of their first occurrence.
std::vector<std::string> names(const std::vector<OverviewCell>& cells, std::string OverviewCell::* member) {
    std::vector<std::string> names;
    for (const OverviewCell& cell : cells)
        if (std::find(names.begin(), names.end(), cell.*member) == names.end())
            names.push_back(cell.*member);
    return names;
}

using Cell = ReportTable::Cell;

/// Returns the style class of a verdict.
std::string style_class_of(Verdict::Kind kind) {
    switch (kind) {
    case Verdict::Kind::ok:
        return "ok";
    case Verdict::Kind::worse:
        return "worse";
    case Verdict::Kind::fails:
        return "fails";
    case Verdict::Kind::undecided:
        break;
    }
    return "undecided";
}

Cell overview_cell(const OverviewCell& of) {
    const std::string look = style_class_of(of.verdict),
                      ratio = std::isfinite(of.factor) ? fmt::format(" {:.3g}", of.factor) : "";
    if (of.verdict == Verdict::Kind::ok)
        return {"ok" + ratio, "", look};
    if (of.verdict == Verdict::Kind::worse)
        return {"", "worse" + ratio, look};
    return {ratio, to_string(of.verdict), look};
}

} // namespace

ReportTable overview(const std::vector<OverviewCell>& cells) {
    ReportTable table;
    table.columns.push_back({"scene"});
    const std::vector<std::string> setups = names(cells, &OverviewCell::setup);
    for (const std::string& setup : setups)
        table.columns.push_back({setup});
    for (const std::string& scene : names(cells, &OverviewCell::scene)) {
        std::vector<Cell>& row = table.rows.emplace_back(1, Cell{scene, "", "", scene});
        for (const std::string& setup : setups) {
            const auto cell = std::find_if(cells.begin(), cells.end(), [&](const OverviewCell& c) {
                return c.scene == scene && c.setup == setup;
            });
            row.push_back(cell == cells.end() ? Cell{} : overview_cell(*cell));
        }
    }
    return table;
}

std::string anchor(const std::string& scene) {
    return fmt::format("<a id=\"{}\"></a>", scene);
}

namespace {

/// Returns the image times `factor`, with its pixels doubled in size.
RgbImage enlarged(const RgbImage& image, float factor) {
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

/// Returns the bias as root of the squared bias, with the upper limit of its interval. A negative estimate is
/// noise and counts as 0.
std::string bias_cell(const Deviation& d) {
    return fmt::format("{:.2f} (< {:.2f})", 100 * std::sqrt(std::max(0.0, d.value)),
                       100 * std::sqrt(std::max(0.0, d.value + 2 * d.error)));
}

Cell verdict_cell(const StabilityRow& row) {
    const std::string word = to_string(row.verdict.kind), look = style_class_of(row.verdict.kind);
    return row.verdict.cause.empty() ? Cell{word, "", look} : Cell{": " + row.verdict.cause, word, look};
}

std::vector<OverviewCell> cells_of(const std::vector<StabilityRow>& rows) {
    std::vector<OverviewCell> cells;
    for (const StabilityRow& row : rows)
        cells.push_back({row.of->name(), name_of(row.result), row.verdict.kind, row.findings.factor});
    return cells;
}

std::vector<ReportTable::Column> columns() {
    return {
        {""},
        {"verdict"},
        {"error at equal time / PT's", true},
        {"relMSE", true},
        {"FLIP", true,
         "difference that an observer perceives when flipping between picture and reference, from 0 to 1"},
        {"spp", true},
        {"energy %", true},
        {"bias %", true, "RMS bias of pieces, without noise, and its upper limit (2 standard errors)"},
        {"outliers", true, "99.99th percentile of the pixels' relative errors over all seeds"},
        {"worst pixel", true},
        {"worst pixels' share", true, "fraction of relMSE in the worst pixels, about 1 in 1000 (at least 16)"},
        {"off 10x %", true, "pixels with more than ten times the reference's luminance, or less than a tenth"},
        {"tone-mapped", true, "1000 times the mean squared error of x / (1 + x), which fireflies do not dominate"},
        {"halo", true,
         "energy that the brightest firefly adds outside of its tile, over its own energy, and the largest change "
         "of a pixel there, over its brightness (a ring or a blob; for redistributed energy the first is about 1, "
         "the second small)"},
        {"tile edges", true, "spectrum of squared pixel differences at the tile frequency; 1: no visible grid"}};
}

ReportTable table_of(const std::vector<StabilityRow>& rows) {
    ReportTable table{columns(), {}};
    for (const StabilityRow& row : rows) {
        const Findings& f = row.findings;
        table.rows.push_back({{name_of(row.result)},
                              verdict_cell(row),
                              {fmt::format("{} ({} to {})", cell(f.factor), cell(f.low), cell(f.high))},
                              {fmt::format("{:.3g} ± {:.1g}", f.error, f.error_error)},
                              {cell(column_value("flip", row.result))},
                              {fmt::format("{:.4g}", spp_of(row.result))},
                              {percent(f.energy)},
                              {bias_cell(f.squared_bias)},
                              {fmt::format("{:.3g}", f.spike)},
                              {fmt::format("{:.3g} at {},{}", f.worst, f.worst_pixel.x, f.worst_pixel.y)},
                              {fmt::format("{:.0f} %", 100 * f.worst_fraction)},
                              {fmt::format("{:.3g}", 100 * f.tenfold)},
                              {fmt::format("{:.3g}", 1000 * f.tone_mapped)},
                              {fmt::format("{} ({})", cell(f.halo_energy), cell(f.halo_peak))},
                              {cell(f.tile_edges)}});
    }
    return table;
}

/// Returns "96x72 pixels, 1 CPU s, 20 seeds. Reference: ...".
std::string conditions(const StabilityCase& c) {
    const FloorFreeError error = error_of(reference_of(c));
    const glm::ivec2 size = c.options->settings.size;
    return fmt::format("{}x{} pixels, {}, {} seeds. Reference: by {}, relMSE of its own {:.2g} ± {:.1g}.", size.x,
                       size.y, to_string(c.options->effort), c.options->seeds,
                       to_string(origin_of(reference_of(c))), error.relative_mse, error.standard_error);
}

std::string failure(const StabilityCase& c) {
    return c.scene.fails.empty() ? "" : "Known to fail: " + c.scene.fails;
}

std::string section(const StabilityCase& c, const std::vector<StabilityRow>& rows) {
    return fmt::format("\n{}\n\n## {}\n\n{}\n\n{} ![{}]({}.png)\n\n{}", anchor(c.name()), c.name(), failure(c),
                       conditions(c), c.name(), c.name(), to_markdown(table_of(rows)));
}

std::string page_section(const StabilityCase& c, const std::vector<StabilityRow>& rows) {
    std::vector<Result> results;
    std::vector<NamedResult> named;
    for (const StabilityRow& row : rows) {
        results.push_back(row.result);
        named.push_back({name_of(row.result), &row.result});
    }
    std::string charts;
    for (const Chart& chart : sweep_charts(*c.options, results))
        charts += to_svg(chart);
    const RgbImage& reference = reference_of(c).mean;
    const std::vector<PagePicture> pictures = pictures_of(*c.experiment, named, reference);
    return fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n<p class=\"note\">{2}</p>\n{3}{4}{5}",
                       escaped(c.name()), escaped(failure(c)), escaped(conditions(c)), to_html(table_of(rows)),
                       pictures.empty() ? "" : comparison(reference, pictures, auto_exposure(reference)), charts);
}

/// Introduction of the report: the conditions, and notes as pairs of a term (may be empty) and its meaning.
struct Introduction {
    std::string conditions;
    std::vector<std::pair<std::string, std::string>> notes;
};

Introduction introduction(const ExperimentOptions& suite, double level) {
    std::string terms = "Radiances are in units of the reference's mean luminance.";
    for (const ReportTable::Column& column : columns())
        if (!column.meaning.empty())
            terms += fmt::format(" {}: {}.", column.name, column.meaning);
    const glm::ivec2 size = suite.settings.size;
    return {
        fmt::format(
            "{}x{} pixels, {} each, {} seeds, unless a scene states other needs; {}. References are by path "
            "tracing, which reuses no paths, with other seeds than the pictures.",
            size.x, size.y, to_string(suite.effort), suite.seeds, cpu_model()),
        {{"fails", fmt::format("pixels are not finite, or the mean over the seeds differs from the reference by "
                               "more than {:.1f} sigma, in energy (mean luminance) or in the squared bias of "
                               "pieces of 8x8 pixels. Unbiased reconstructions (such as none, l2) are allowed "
                               "rounding errors; the others, 2 % of the energy and 10 % RMS of the pieces.",
                               sigmas(level))},
         {"worse", "relMSE times CPU seconds (reconstruction included) is larger than PT's, with 95 % confidence "
                   "from the seeds."},
         {"undecided",
          "the setup is biased, but so is PT against its own reference: one of them lacks rare light paths."},
         {"", fmt::format("Sigmas are corrected for the number of tests: a suite calls any unbiased mean biased "
                          "with a probability of at most 1 % (level {:.1e} each). Intervals are not corrected: a "
                          "setup that equals PT is called worse with a probability of 1 in 40.",
                          level)},
         {"", terms}}};
}

std::string markdown(const Introduction& introduction) {
    std::string text = "# Stability\n\n" + introduction.conditions + "\n\n";
    for (const auto& [term, meaning] : introduction.notes)
        text += term.empty() ? fmt::format("- {}\n", meaning) : fmt::format("- **{}**: {}\n", term, meaning);
    return text + "\n";
}

std::string html(const Introduction& introduction) {
    std::string text = fmt::format("<p>{}</p>\n<ul class=\"note\">", escaped(introduction.conditions));
    for (const auto& [term, meaning] : introduction.notes)
        text += term.empty() ? fmt::format("<li>{}</li>\n", escaped(meaning))
                             : fmt::format("<li><b>{}</b>: {}</li>\n", term, escaped(meaning));
    return text + "</ul>\n";
}

} // namespace

void write_stability(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases) {
    const double level = level_of(suite, cases);
    const std::vector<StabilityRow> rows = rows_of(cases, level);
    const Introduction words = introduction(suite, level);
    const ReportTable verdicts = overview(cells_of(rows));
    std::string text = markdown(words) + to_markdown(verdicts);
    std::string page = interruption_note() + html(words) + to_html(verdicts);
    for (const StabilityCase& c : cases) {
        std::vector<StabilityRow> of_case;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_case),
                     [&](const StabilityRow& r) { return r.of == &c; });
        if (of_case.empty())
            continue;
        text += section(c, of_case);
        page += page_section(c, of_case);
    }
    write_text(suite.output / "stability.md", text);
    write_text(suite.output / "stability.csv", to_csv(rows));
    write_text(suite.output / "stability.html", html_page("Stability", page));
}

void write_sheet(const ExperimentOptions& suite, const StabilityCase& c) {
    const std::vector<Result> results = c.experiment->results();
    if (results.empty())
        return;
    std::vector<NamedResult> named;
    for (const Result& result : results)
        named.push_back({name_of(result), &result});
    const RgbImage& reference = reference_of(c).mean;
    const float brighter = std::exp2(auto_exposure(reference));
    std::vector<LabelledPicture> pictures = {{"reference", enlarged(reference, brighter)}};
    for (const PagePicture& picture : pictures_of(*c.experiment, named, reference))
        pictures.push_back({picture.name, enlarged(picture.image, brighter)});
    write_png(suite.output / (c.name() + ".png"), picture_sheet(pictures, 4));
}

} // namespace tessera
