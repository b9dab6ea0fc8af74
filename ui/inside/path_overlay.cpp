#include "render/inspect/inspection.h"
#include "render/scene/scene.h"
#include "ui/gl/theme.h"
#include "ui/inside/drawing.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <tuple>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr ImU32 shadow_colour = IM_COL32(0, 0, 0, 150);
constexpr float least_pixel = 2; // smallest pixel edge, screen units, at which sets are filled

void mark_pixel(const PictureFrame& frame, glm::ivec2 pixel, glm::ivec2 size, ImU32 colour) {
    const glm::vec2 a = frame.to_screen(glm::vec2(pixel) / glm::vec2(size));
    const glm::vec2 b = frame.to_screen(glm::vec2(pixel + 1) / glm::vec2(size));
    const float least = ImGui::GetFontSize() * 0.3f, grow = std::max((least - (b.x - a.x)) * 0.5f, 0.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect({a.x - grow - 1, a.y - grow - 1}, {b.x + grow + 1, b.y + grow + 1}, shadow_colour);
    list.AddRect({a.x - grow, a.y - grow}, {b.x + grow, b.y + grow}, colour);
}

/// Draws the pixel's sampling sets, and fills the pixels that shown shifts come from, or go to, by outcome.
void draw_sets(const PictureFrame& frame, const Inspector& inspector) {
    const Inspection& inspection = *inspector.inspection;
    const SetDrawing drawing(frame, inspection.size);
    const float width = std::max(ImGui::GetFontSize() / 10, 1.0f);
    const bool to_pixel = inspector.direction == Inspector::Direction::to_pixel;
    if (drawing.unit() >= least_pixel)
        for (const InspectedShift* s : shown_shifts(inspector))
            if (s->from != s->to)
                drawing.fill(to_pixel ? s->from : s->to,
                             with_alpha(outcome_colour(*s), is_black(s->value) ? 0.16f : 0.42f));
    for (const InspectedSet& set : inspection.sets) {
        drawing.outline(set, true, set_colours::border, width);
        drawing.outline(set, false, set_colours::inner, width);
    }
}

} // namespace

std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector) {
    std::vector<const InspectedShift*> shifts;
    for (const InspectedSet& set : inspector.inspection->sets) {
        const glm::ivec2 pixel = inspector.inspection->pixel;
        const auto of_set =
            inspector.direction == Inspector::Direction::to_pixel ? set.to(pixel) : set.from(pixel);
        shifts.insert(shifts.end(), of_set.begin(), of_set.end());
    }
    std::stable_sort(shifts.begin(), shifts.end(), [](const InspectedShift* a, const InspectedShift* b) {
        return std::tuple(a->is_tried, luminance(a->value)) > std::tuple(b->is_tried, luminance(b->value));
    });
    return shifts;
}

void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state) {
    const Inspector& inspector = state.inspector;
    if (!inspector.active || !inspector.sample || !state.scene)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({clip.min.x, clip.min.y}, {clip.max.x, clip.max.y}, true);
    const PaneState& own = state.panes[pane];
    const bool is_shown =
        inspector.inspection && inspector.slot == own.slot && inspector.generation == own.generation;
    if (is_shown) {
        draw_sets(frame, inspector);
        const float radius = state.scene->radius();
        const SceneLines lines(frame, state.camera.camera(), inspector.inspection->size, 1e-4f * radius,
                               inspector.inspection->lens);
        draw_shifts(lines, shown_shifts(inspector), inspector.shown_row());
        draw_base_path(lines, inspector.inspection->path, 0.5f * radius);
    }
    // The pixel of an earlier request may be at another place in the present pictures.
    if (!inspector.sample->origin || state.shows_request(inspector.sample->origin->generation))
        mark_pixel(frame, inspector.sample->pixel, state.request_size(), colours::overlay_accent);
    list.PopClipRect();
}

} // namespace tessera
