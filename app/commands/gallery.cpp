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
constexpr std::string_view shown_setups[] = {"pr", "gpt-guided", "gpr-weighted", judged_setup};

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
    std::string scene, setup, text; ///< such as "glossy-0.01", "gpr-weighted", "worse 1.17"
    bool is_ok = false;
};

/// Returns "worse 1.17" for "worse than PT" and "1.1653"; only the verdict if there is no factor.
std::string short_verdict(const std::string& verdict, const std::string& factor) {
    const std::optional<double> number = parse_number(factor);
    return verdict.substr(0, verdict.find(' ')) + (number ? fmt::format(" {:.3g}", *number) : "");
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
                         short_verdict(verdict, cell("factor")), verdict == "ok"});
    }
    return found;
}

/// Adds the verdicts of a scene and of the values of its variable. `names` holds the names of all scenes.
void add_verdicts(GalleryEntry& entry, const std::vector<Finding>& findings, const std::set<std::string>& names) {
    std::string scene;
    for (const Finding& finding : findings) {
        const bool is_value = finding.scene.starts_with(entry.title + "-") && !names.contains(finding.scene);
        if (!(is_value || finding.scene == entry.title) ||
            std::ranges::find(shown_setups, finding.setup) == std::end(shown_setups))
            continue;
        if (std::exchange(scene, finding.scene) != finding.scene)
            entry.help += "\n" + finding.scene + ":";
        entry.help += fmt::format("  {} {}", finding.setup, finding.text);
        if (finding.setup != judged_setup)
            continue;
        if (entry.verdict.empty() || !finding.is_ok)
            entry.verdict = "G-PR " + finding.text;
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
        entry.help += "\nError at equal time, relative to PT (stability suite):";
        add_verdicts(entry, findings, names);
        found.entries.push_back(std::move(entry));
    }
    return found;
}

} // namespace tessera
