#include "ui/legend.h"

#include "render/load/png.h"
#include "ui/false_colours.h"
#include "ui/shift_outcomes.h"
#include "ui/theme.h"
#include "ui/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

namespace tessera {

namespace {

// As in canvas.frag.glsl.
constexpr glm::vec3 zero_colour(0.10f, 0.10f, 0.11f), plus_colour(1.00f, 0.66f, 0.20f),
    minus_colour(0.26f, 0.62f, 1.00f);
constexpr int signed_steps = 16; // to each side of zero: sRGB's curve is no line

ImU32 packed(const glm::vec3& c) {
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1});
}

void draw_colours(ImDrawList& list, glm::vec2 min, glm::vec2 max, const std::vector<glm::vec3>& colours) {
    const float step = (max.x - min.x) / static_cast<float>(colours.size() - 1);
    for (std::size_t i = 0; i + 1 < colours.size(); ++i) {
        const float left = min.x + step * static_cast<float>(i);
        const ImU32 from = packed(colours[i]), to = packed(colours[i + 1]);
        list.AddRectFilledMultiColor({left, min.y}, {left + step, max.y}, from, to, to, from);
    }
}

constexpr float spot_width = 0.8f; // of an entry's colour, with the space behind it; in sizes of the font

/// Where entries go, row by row.
struct EntryPlaces {
    std::vector<glm::vec2> at; // from the first one's top left
    glm::vec2 size{0};
};

EntryPlaces places_of(const std::vector<LegendEntry>& entries, float widest) {
    const float font = ImGui::GetFontSize(), line = std::floor(font * 1.15f);
    EntryPlaces places;
    glm::vec2 at(0);
    for (const LegendEntry& entry : entries) {
        const float width = font * spot_width + ImGui::CalcTextSize(entry.name.c_str()).x;
        if (at.x > 0 && at.x + width > widest)
            at = {0, at.y + line};
        places.at.push_back(at);
        places.size = glm::max(places.size, glm::vec2(at.x + width, at.y + line));
        at.x += width + font;
    }
    return places;
}

void draw_entries(ImDrawList& list, glm::vec2 min, const std::vector<LegendEntry>& entries,
                  const EntryPlaces& places) {
    const float font = ImGui::GetFontSize();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const glm::vec2 at = min + places.at[i];
        list.AddCircleFilled({at.x + font * 0.3f, at.y + font * 0.55f}, font * 0.28f, entries[i].colour, 12);
        list.AddText({at.x + font * spot_width, at.y}, colours::overlay_text, entries[i].name.c_str());
    }
}

} // namespace

Legend false_colour_legend(Buffer buffer, const ValueRange& range) {
    return {
        legend_text(buffer, range),
        std::string(info(buffer).help) +
            "\n\nAll panes that show it have this range. Drag the colours' left or right half to move that end "
            "of it; double click: back to the range that fits the first pictures.",
        {std::begin(false_colours), std::end(false_colours)},
        {}};
}

Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure) {
    const double end = static_cast<double>(std::exp2(-exposure) * scale);
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, ": %+.3g .. %+.3g", -end, end);
    Legend legend{about + numbers + (unit.empty() ? "" : " ") + unit,
                  "Luminance: blue below zero, orange above. The exposure (+ and -) moves the ends.",
                  {},
                  {}};
    for (int i = -signed_steps; i <= signed_steps; ++i) {
        const float share = static_cast<float>(i) / signed_steps;
        legend.colours.push_back(
            glm::mix(zero_colour, share < 0 ? minus_colour : plus_colour, srgb_encoded(std::abs(share))));
    }
    return legend;
}

Legend outcome_legend() {
    Legend legend{"outcomes of shifts to a pixel", info(Buffer::outcomes).help, {}, {}};
    legend.help += '\n';
    for (int i = 0; i < shift_outcome_count; ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        legend.entries.push_back({in_words(to_string(outcome)), outcome_colour(outcome)});
        legend.help += "\n" + legend.entries.back().name + ": " + outcome_help(outcome);
    }
    return legend;
}

LegendPlace draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                        Controls& controls) {
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.5f), bar = std::floor(font * 0.5f);
    const ImVec2 text_size = ImGui::CalcTextSize(legend.text.c_str());
    const EntryPlaces entries =
        places_of(legend.entries, std::min(picture.size().x - 4 * pad, font * widest_legend));
    const bool has_bar = !legend.colours.empty();
    const glm::vec2 size(std::max({text_size.x, has_bar ? font * 10 : 0, entries.size.x}) + 2 * pad,
                         text_size.y + 2 * pad + (has_bar ? bar + 0.5f * pad : 0) + entries.size.y);
    if (size.x + 2 * pad > picture.size().x || size.y + 2 * pad > picture.size().y)
        return {};
    const float left = at_right ? picture.max.x - pad - size.x : picture.min.x + pad;
    const glm::vec2 min(left, picture.max.y - pad - size.y), max = min + size;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({min.x, min.y}, {max.x, max.y}, colours::overlay, pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad}, colours::overlay_text, legend.text.c_str());
    draw_entries(list, {min.x + pad, max.y - pad - entries.size.y}, legend.entries, entries);
    LegendPlace place{{min, max}, {}};
    if (has_bar) {
        place.bar = {{min.x + pad, max.y - pad - bar}, {max.x - pad, max.y - pad}};
        draw_colours(list, place.bar.min, place.bar.max, legend.colours);
    }

    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({min.x, min.y});
    ImGui::Dummy({size.x, size.y});
    controls.note(id.c_str(), legend.help.c_str());
    ImGui::SetCursorScreenPos(cursor);
    return place;
}

} // namespace tessera
