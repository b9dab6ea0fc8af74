#include "ui/viewer/picture_area.h"

#include "render/scene/scene.h"
#include "ui/inside/inside.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// Returns the rectangle of a pane. Two panes are arranged to maximise picture size; three or four lie in two
/// rows.
ScreenRect pane_rect(const ScreenRect& all, int pane, int panes, glm::vec2 picture) {
    const float strips = 3.6f * ImGui::GetFontSize(); // total height of the strips above and below a picture
    const auto scale = [&](int columns, int rows) {
        const glm::vec2 room = all.size() / glm::vec2(columns, rows) - glm::vec2(0, strips);
        return std::min(room.x / picture.x, room.y / picture.y);
    };
    const int rows = panes > 2 || (panes == 2 && scale(1, 2) > scale(2, 1)) ? 2 : 1;
    const int columns = (panes + rows - 1) / rows;
    const glm::vec2 cell = all.size() / glm::vec2(columns, rows);
    const glm::vec2 min = all.min + cell * glm::vec2(pane % columns, pane / columns);
    return {glm::floor(min), glm::floor(min + cell)};
}

} // namespace

/// Takes the image of each pane's buffer, and of the reference if a pane is compared with it.
void PictureArea::take_images(const ViewerState& state) {
    bool wants_reference = false;
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        images_[i].take(state.panes[i].snapshot.get(), state.panes[i].settings.buffer, state.companions);
        wants_reference |= state.compared_with(static_cast<int>(i)) == the_reference;
    }
    for (std::size_t i = state.panes.size(); i < most_panes; ++i)
        images_[i].take(nullptr, Buffer::reconstruction, {});
    images_[the_reference].take(nullptr, Buffer::reference, wants_reference ? state.companions : Companions{});
}

void PictureArea::draw(const ScreenRect& where, Controls& controls, ViewerState& state) {
    take_images(state);
    const int panes = static_cast<int>(state.panes.size());
    std::optional<Cursor>& cursor = state.layout.cursor;
    if (cursor && (cursor->pane >= panes || !state.is_on_show(cursor->pane)))
        cursor.reset();
    PaneTools tools{shader_, images_, controls, state};
    const int alone = state.layout.alone ? state.active_pane : -1;
    const glm::vec2 picture(state.sensor_size());
    const auto each = [&](auto&& act) {
        for (int i = 0; i < panes; ++i) {
            if (alone < 0 || alone == i)
                act(views_[i], i);
        }
    };
    each([&](PaneView& view, int i) {
        view.take_input(i, alone < 0 ? pane_rect(where, i, panes, picture) : where, tools);
    });
    each([&](PaneView& view, int i) { view.draw(i, tools); });
}

void PictureArea::expose(ViewerState& state) const {
    const auto clamped = [](float stops) {
        return std::clamp(stops, ranges::exposure.low(), ranges::exposure.high());
    };
    if (shows_slow_motion(state.active_pane, state)) { // it covers the picture
        if (const auto exposure = exposure_of(slow_motion_luminances(state.slow_motion)))
            state.display.tone.exposure = clamped(*exposure);
        return;
    }
    const Showing showing = sides_of(state, state.active_pane).left;
    const PaneImage& image = images_[showing.pane];
    if (image.empty())
        return;
    const Buffer buffer = buffer_of(showing.pane, state);
    const ColourMap map = colour_map(showing, state);
    if (map == ColourMap::false_colour)
        state.display.ranges[buffer] = automatic_range(buffer, image.pixels(), state.companions);
    else if (const auto exposure = exposure_of(showing, images_); exposure && map == ColourMap::signed_difference)
        state.display.tone.difference_exposure =
            clamped(*exposure) - state.display.tone.exposure; // relative to the exposure of the pictures
    else if (exposure)
        state.display.tone.exposure = clamped(*exposure);
}

} // namespace tessera
