#include "app/commands/commands.h"
#include "app/experiment/stability.h"
#include "embedded/gallery_pictures.h"
#include "embedded/stability_results.h"
#include "render/io/picture_formats.h"
#include "render/io/text.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

/// The setup whose verdict is below a picture, and the setups in its tooltip.
constexpr std::string_view judged_setup = "gpr-guided";
struct ShownSetup {
    std::string_view name, column;
};
constexpr ShownSetup shown_setups[] = {
    {"pr", "PR"}, {"gpt-guided", "G-PT guided"}, {"gpr-weighted", "G-PR weighted"}, {judged_setup, "G-PR guided"}};

RgbImage picture_of(const std::string& name) {
    for (const EmbeddedFile& file : gallery_pictures) {
        if (file.name == name + ".jpg")
            return to_rgb(parse_jpeg(file.text(), [] { return true; }));
    }
    return {};
}

/// Splits a line of CSV into cells and removes quotes.
std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (const char c : line) {
        is_quoted = is_quoted != (c == '"');
        if (c == ',' && !is_quoted)
            cells.emplace_back();
        else if (c != '"')
            cells.back() += c;
    }
    return cells;
}

/// Verdict of the stability suite on a setup, for a scene or for one value of its variable.
struct Finding {
    std::string scene, setup; ///< such as "glossy-0.01", "gpr-weighted"
    std::string verdict;      ///< its first word, such as "worse"
    std::string factor;       ///< squared error relative to PT at equal time, such as "1.17"; empty: unknown
    bool is_ok = false;
};

/// Returns "1.17" for "1.1653"; empty for no number.
std::string short_factor(const std::string& factor) {
    const std::optional<double> number = parse_number(factor);
    return number ? fmt::format("{:.3g}", *number) : "";
}

/// Parses a table written by the suite (stability.csv).
std::vector<Finding> findings_of(std::string_view table) {
    std::vector<Finding> found;
    std::istringstream in{std::string(table)};
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = cells_of(line);
    while (std::getline(in, line)) {
        const std::vector<std::string> cells = cells_of(line);
        const auto cell = [&](std::string_view name) {
            const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
            return place < cells.size() ? cells[place] : std::string();
        };
        const std::string method = cell("method"), recon = cell("recon"), verdict = cell("verdict");
        found.push_back({cell("scene"),
                         recon == "none" && !method.starts_with("g") ? method : method + "-" + recon,
                         verdict.substr(0, verdict.find(' ')), short_factor(cell("factor")), verdict == "ok"});
    }
    return found;
}

/// Adds the errors of a scene and of the values of its variable. `names` holds the names of all scenes.
void add_errors(GalleryEntry& entry, const std::vector<Finding>& findings, const std::set<std::string>& names) {
    entry.errors.columns = {"Scene"};
    for (const ShownSetup& setup : shown_setups)
        entry.errors.columns.emplace_back(setup.column);
    for (const Finding& finding : findings) {
        const bool is_value = finding.scene.starts_with(entry.title + "-") && !names.contains(finding.scene);
        const auto* place = std::ranges::find(shown_setups, finding.setup, &ShownSetup::name);
        if (!(is_value || finding.scene == entry.title) || place == std::end(shown_setups))
            continue;
        auto& rows = entry.errors.rows;
        if (rows.empty() || rows.back().front().text != finding.scene) {
            rows.emplace_back(entry.errors.columns.size(), ErrorTable::Cell{"-"});
            rows.back().front().text = finding.scene;
        }
        const std::string text = finding.factor.empty() ? finding.verdict : finding.factor;
        rows.back()[1 + static_cast<std::size_t>(place - std::begin(shown_setups))] = {text, !finding.is_ok};
        if (finding.setup != judged_setup)
            continue;
        if (entry.verdict.empty() || !finding.is_ok)
            entry.verdict =
                fmt::format("G-PR {}{}{}", finding.verdict, finding.factor.empty() ? "" : " ", finding.factor);
        entry.is_worse = entry.is_worse || !finding.is_ok;
    }
}

} // namespace

GalleryContents gallery(const std::function<std::vector<std::filesystem::path>()>& find_scenes,
                        std::string_view results) {
    const std::vector<Finding> findings = findings_of(results.empty() ? stability_results : results);
    GalleryContents found;
    found.entries.push_back({"cornell-box",
                             "The built-in scene, with which the viewer starts.",
                             "",
                             false,
                             {},
                             picture_of("cornell-box")});
    std::vector<std::filesystem::path> files;
    try {
        files = find_scenes();
    } catch (const std::exception& error) {
        found.problem = std::string("the scenes of the stability suite are not available: ") + error.what();
    }
    std::set<std::string> names;
    for (const std::filesystem::path& file : files)
        names.insert(file.stem().string());
    for (const std::filesystem::path& file : files) {
        const std::string name = file.stem().string();
        GalleryEntry entry{name, known_failure(file), "", false, file, picture_of(name)};
        add_errors(entry, findings, names);
        if (!entry.errors.rows.empty())
            entry.help += "\n\nError at equal time relative to PT (lower is better):";
        found.entries.push_back(std::move(entry));
    }
    return found;
}

} // namespace tessera
