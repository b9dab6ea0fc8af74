#include "app/stability_overview.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Each once, in the order in which they come.
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
    const std::vector<std::string> points = names(cells, &OverviewCell::point);
    std::string text = "| scene |", rule = "| --- |";
    for (const std::string& point : points) {
        text += fmt::format(" {} |", point);
        rule += " --- |";
    }
    text += "\n" + rule + "\n";
    for (const std::string& scene : names(cells, &OverviewCell::scene)) {
        text += fmt::format("| [{0}](#{0}) |", scene);
        for (const std::string& point : points) {
            const auto cell = std::find_if(cells.begin(), cells.end(), [&](const OverviewCell& c) {
                return c.scene == scene && c.point == point;
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

} // namespace tessera
