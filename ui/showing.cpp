#include "ui/showing.h"

namespace tessera {

namespace {

const PaneSettings& settings(const ViewerState& state, int pane) {
    return state.panes[static_cast<std::size_t>(pane)].settings;
}

std::string name(const ViewerState& state, int pane) {
    return std::to_string(pane + 1) + "  " + std::string(paper_name(settings(state, pane).render.method));
}

} // namespace

Showing showing_at(const ViewerState& state, int pane, float share) {
    const int other = state.compared_with(pane);
    if (other == pane)
        return {pane};
    if (state.flicker && pane == state.active_pane)
        return {other};
    switch (settings(state, pane).comparison.kind) {
    case Comparison::Kind::off:
        break;
    case Comparison::Kind::wipe:
        return {share < state.wipe ? pane : other};
    case Comparison::Kind::difference:
        return {pane, other};
    }
    return {pane};
}

ColourMap colour_map(const Showing& showing, const ViewerState& state) {
    return showing.subtrahend >= 0 ? ColourMap::signed_difference
                                   : colour_map(settings(state, showing.pane).buffer);
}

ValueRange range_of(const Showing& showing, const ViewerState& state, const PaneImages& images) {
    const auto set = state.ranges.find(settings(state, showing.pane).buffer);
    return set != state.ranges.end() ? set->second : images[static_cast<std::size_t>(showing.pane)].range();
}

std::optional<Rgb> value_at(const Showing& showing, const PaneImages& images, glm::vec2 place) {
    const PaneImage& image = images[static_cast<std::size_t>(showing.pane)];
    if (image.empty() || place.x < 0 || place.y < 0 || place.x >= 1 || place.y >= 1)
        return std::nullopt;
    if (showing.subtrahend < 0)
        return image.at(place);
    const PaneImage& other = images[static_cast<std::size_t>(showing.subtrahend)];
    return other.empty() ? image.at(place) : image.at(place) - other.at(place);
}

std::string label_of(const Showing& showing, const ViewerState& state) {
    if (showing.subtrahend >= 0)
        return name(state, showing.pane) + "  minus  " + name(state, showing.subtrahend);
    return name(state, showing.pane) + "  " + std::string(long_name(settings(state, showing.pane).buffer));
}

} // namespace tessera
