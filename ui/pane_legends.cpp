#include "ui/pane_legends.h"

#include <algorithm>

#include <imgui.h>

namespace tessera {

namespace {

bool has_picture(const Showing& showing, const PaneTools& tools) {
    const auto has = [&](int pane) { return !tools.images[static_cast<std::size_t>(pane)].empty(); };
    return has(showing.pane) && (showing.subtrahend < 0 || has(showing.subtrahend));
}

/// Of gradients, or of a difference, which has a unit if both its buffers have.
Legend signed_legend_of(const Showing& showing, const ViewerState& state) {
    const BufferInfo& about = info(buffer_of(showing.pane, state));
    if (showing.subtrahend < 0)
        return signed_legend(about.id, about.unit, about.unit_scale, state.tone.exposure);
    const bool alike = buffer_of(showing.subtrahend, state) == about.buffer;
    return signed_legend("difference", alike ? about.unit : "", alike ? about.unit_scale : 1, state.tone.exposure);
}

/// First hits of where the camera was are shown until there are others.
bool is_of_earlier_view(const Showing& showing, const ViewerState& state) {
    const auto has_first_hits = [&](int pane) {
        return pane >= 0 && family(buffer_of(pane, state)) == BufferFamily::first_hit;
    };
    return state.companions.first_hits_are_earlier &&
           (has_first_hits(showing.pane) || has_first_hits(showing.subtrahend));
}

/// Without text: the picture needs none.
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
                       "The camera or the size has changed since; what it sees now is being traced.";
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
    const bool same = sides.left.subtrahend == sides.right.subtrahend &&
                      buffer_of(sides.left.pane, state) == buffer_of(sides.right.pane, state);
    const bool left_is_seen = !sides.divided() || state.wipe > 0;
    const bool right_is_seen = sides.divided() && state.wipe < 1;
    drawn_ = {};
    ScreenRect room = frame.rect;
    if (left_is_seen)
        drawn_[0] = draw_one(room, id + ".legend", sides.left, false, tools);
    const ScreenRect& left = drawn_[0].place.whole;
    if (left.size().y > 0 && room.size().x < 2 * widest_legend * ImGui::GetFontSize())
        room.max.y = left.min.y; // above it
    if (right_is_seen && !(same && left_is_seen))
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
        place.bar = {}; // only the range of these can be dragged
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
