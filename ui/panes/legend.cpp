#include "ui/panes/legend.h"

#include "render/io/plain_images.h"
#include "ui/gl/theme.h"
#include "ui/gl/tone.h"
#include "ui/state/inspected.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

// The same colours as in canvas.frag.glsl.
constexpr glm::vec3 zero_colour(0.10f, 0.10f, 0.11f), plus_colour(1.00f, 0.66f, 0.20f),
    minus_colour(0.26f, 0.62f, 1.00f);
constexpr int signed_steps = 16; // to each side of zero, because the sRGB curve is not linear

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

constexpr float spot_width = 0.8f; // of an entry's spot and the space after it, font sizes

/// Positions of entries in rows.
struct EntryPlaces {
    std::vector<glm::vec2> at; // upper left corners, relative to the first one's
    glm::vec2 size{0};         // of all rows
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
    return {legend_text(buffer, range),
            std::string(info(buffer).help) + "\n\nAll panes with this buffer share the range. Drag the left or "
                                             "right half of the colours to move that "
                                             "end. Double-click for the automatic range.",
            {std::begin(false_colours), std::end(false_colours)},
            {}};
}

Legend signed_legend(const std::string& about, const std::string& unit, float scale, float exposure) {
    const double end = static_cast<double>(std::exp2(-exposure) * scale);
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, ": %+.3g .. %+.3g", -end, end);
    Legend legend{about + numbers + (unit.empty() ? "" : " ") + unit,
                  "Luminance: blue below zero, orange above. The exposure (keys + and -) moves the ends.",
                  {},
                  {}};
    for (int i = -signed_steps; i <= signed_steps; ++i) {
        const float share = static_cast<float>(i) / signed_steps;
        legend.colours.push_back(
            glm::mix(zero_colour, share < 0 ? minus_colour : plus_colour, linear_to_srgb(std::abs(share))));
    }
    return legend;
}

Legend outcome_legend() {
    Legend legend{"outcomes of shifts to the pixel", info(Buffer::outcomes).help, {}, {}};
    legend.help += '\n';
    for (int i = 0; i < shift_outcome_count; ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        legend.entries.push_back({label_of_identifier(to_string(outcome)), outcome_colour(outcome)});
        legend.help += "\n" + legend.entries.back().name + ": " + outcome_help(outcome);
    }
    return legend;
}

LegendPlace draw_legend(const ScreenRect& picture, const std::string& id, const Legend& legend, bool at_right,
                        Controls& controls) {
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.5f), bar = std::floor(font * 0.5f);
    const ImVec2 text_size = ImGui::CalcTextSize(legend.text.c_str());
    const EntryPlaces entries =
        places_of(legend.entries, std::min(picture.size().x - 4 * pad, font * max_legend_ems));
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
    controls.place(id.c_str(), legend.help.c_str());
    ImGui::SetCursorScreenPos(cursor);
    return place;
}

namespace {

bool has_picture(const Showing& showing, const PaneTools& tools) {
    const auto has = [&](int pane) { return !tools.images[pane].empty(); };
    return has(showing.pane) && (showing.subtrahend < 0 || has(showing.subtrahend));
}

/// Returns the legend of gradients, or of a difference, which has a unit if both buffers are the same.
Legend signed_legend_of(const Showing& showing, const ViewerState& state) {
    const BufferInfo& about = info(buffer_of(showing.pane, state));
    if (showing.subtrahend < 0)
        return signed_legend(about.id, about.unit, about.unit_scale, state.display.tone.of_differences());
    const bool same_buffer = buffer_of(showing.subtrahend, state) == about.buffer;
    return signed_legend("difference", same_buffer ? about.unit : "", same_buffer ? about.unit_scale : 1,
                         state.display.tone.of_differences());
}

/// Whether first hits of a previous camera are shown, until new ones are traced.
bool is_of_earlier_view(const Showing& showing, const ViewerState& state) {
    const auto has_first_hits = [&](int pane) {
        return pane >= 0 && family(buffer_of(pane, state)) == BufferFamily::first_hit;
    };
    return state.companions.first_hits_are_earlier &&
           (has_first_hits(showing.pane) || has_first_hits(showing.subtrahend));
}

/// Returns the legend of a picture; one without text if it needs none.
Legend legend_of(const Showing& showing, const PaneTools& tools) {
    const Buffer buffer = buffer_of(showing.pane, tools.state);
    Legend legend;
    if (colour_map(showing, tools.state) == ColourMap::false_colour)
        legend = false_colour_legend(buffer, range_of(buffer, tools.state, tools.images));
    else if (colour_map(showing, tools.state) == ColourMap::signed_difference)
        legend = signed_legend_of(showing, tools.state);
    else if (colour_map(showing, tools.state) == ColourMap::own)
        legend = outcome_legend();
    if (is_of_earlier_view(showing, tools.state)) {
        legend.text = (legend.text.empty() ? std::string(info(buffer).id) : legend.text) + "  of an earlier view";
        legend.help += std::string(legend.help.empty() ? "" : "\n\n") +
                       "The camera or the size has changed; the new first hits are being traced.";
    }
    return legend;
}

} // namespace

ValueRange HeldRange::at(float x) const {
    const float share = (x - from) / length;
    return high ? range.with_high_dragged(share) : range.with_low_dragged(share);
}

void PaneLegends::draw(const PictureFrame& frame, const std::string& id, int pane, PaneTools& tools) {
    const ViewerState& state = tools.state;
    const Sides sides = sides_of(state, pane);
    const bool same_colours = sides.left.subtrahend == sides.right.subtrahend &&
                              buffer_of(sides.left.pane, state) == buffer_of(sides.right.pane, state);
    const bool left_is_seen = !sides.divided() || state.layout.wipe > 0;
    const bool right_is_seen = sides.divided() && state.layout.wipe < 1;
    drawn_ = {};
    ScreenRect room = frame.rect;
    if (left_is_seen)
        drawn_[0] = draw_one(room, id + ".legend", sides.left, false, tools);
    const ScreenRect& left = drawn_[0].place.whole;
    if (left.size().y > 0 && room.size().x < 2 * max_legend_ems * ImGui::GetFontSize())
        room.max.y = left.min.y; // above the left legend
    if (right_is_seen && !(same_colours && left_is_seen))
        drawn_[1] = draw_one(room, id + ".right_legend", sides.right, true, tools);
}

PaneLegends::Drawn PaneLegends::draw_one(const ScreenRect& rect, const std::string& id, const Showing& showing,
                                         bool at_right, PaneTools& tools) {
    if (!has_picture(showing, tools))
        return {};
    const Legend legend = legend_of(showing, tools);
    if (legend.text.empty())
        return {};
    LegendPlace place = draw_legend(rect, id, legend, at_right, tools.controls);
    if (colour_map(showing, tools.state) != ColourMap::false_colour)
        place.bar = {}; // only false colours can be dragged
    return {place, buffer_of(showing.pane, tools.state)};
}

std::optional<HeldRange> PaneLegends::held_at(glm::vec2 point, const PaneTools& tools) const {
    const float margin = ImGui::GetFontSize() * 0.4f;
    for (const Drawn& legend : drawn_) {
        const ScreenRect& bar = legend.place.bar;
        if (bar.size().x > 0 && ScreenRect{bar.min - margin, bar.max + margin}.contains(point))
            return HeldRange{legend.buffer, point.x >= (bar.min.x + bar.max.x) * 0.5f, point.x, bar.size().x,
                             range_of(legend.buffer, tools.state, tools.images)};
    }
    return std::nullopt;
}

} // namespace tessera
