#include "ui/state/pane_labels.h"

#include "render/settings/settings_table.h"
#include "ui/state/buffer.h"

#include <cctype>
#include <cstddef>
#include <variant>
#include <vector>

namespace tessera {

namespace {

/// Returns the settings that affect a picture, except the method.
std::vector<Setting> picture_settings(PaneSettings& pane) {
    std::vector<Setting> all = settings_of(pane.render);
    for (const Setting& setting : settings_of(pane.reconstruction, has_gradients(pane.render.method)))
        all.push_back(setting);
    all.push_back(seed_setting(pane.render.seed));
    return all;
}

/// Returns "max depth" for "Max depth"; keeps labels that start with an abbreviation, such as "RR delta".
std::string lower(std::string_view label) {
    std::string text(label);
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])))
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

/// Returns "tile 6", "L1" or "roulette absolute".
std::string in_short(const Setting& setting) {
    const auto* one = std::get_if<Setting::OneOf>(&setting.kind);
    const std::string value = one ? std::string(one->choices[one->get()].label) : setting.text();
    return setting.id == "norm" ? value : lower(setting.label) + " " + value;
}

} // namespace

std::string differences(const PaneSettings& settings, std::span<const PaneSettings> others) {
    PaneSettings own = settings;
    const std::vector<Setting> mine = picture_settings(own);
    std::vector<bool> differs(mine.size());
    for (PaneSettings other : others) {
        const std::vector<Setting> theirs = picture_settings(other);
        for (std::size_t i = 0; i < mine.size(); ++i)
            differs[i] =
                differs[i] || (mine[i].matters && theirs[i].matters && mine[i].text() != theirs[i].text());
    }
    std::string text;
    for (std::size_t i = 0; i < mine.size(); ++i)
        if (differs[i])
            text += (text.empty() ? "" : ", ") + in_short(mine[i]);
    return text;
}

std::string picture_label(const PaneSettings& settings, std::span<const PaneSettings> others) {
    const std::string more = differences(settings, others);
    return std::string(paper_name(settings.render.method)) + (more.empty() ? "" : ", " + more);
}

std::string pane_label(const Document& document, int pane) {
    std::vector<PaneSettings> all;
    for (const PaneState& each : document.panes)
        all.push_back(each.settings);
    return picture_label(all[pane], all);
}

} // namespace tessera
