#include "ui/path_overlay.h"

#include "ui/theme.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr ImU32 base_colour = IM_COL32(255, 255, 255, 255), light_colour = IM_COL32(255, 226, 92, 200);
constexpr ImU32 shadow_colour = IM_COL32(0, 0, 0, 150), untried_colour = IM_COL32(150, 150, 150, 255);

ImU32 with_alpha(ImU32 colour, float share) {
    const auto alpha = static_cast<ImU32>(std::clamp(share, 0.0f, 1.0f) * 255);
    return (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

ImU32 colour_of(const InspectedShift& shift) {
    return shift.is_tried ? outcome_colour(shift.outcome) : untried_colour;
}

/// Lines and points of the scene on the screen.
class SceneLines {
public:
    SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth)
        : frame_(frame), projection_(camera, size), size_(size), least_depth_(least_depth) {}

    void line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const {
        glm::vec3 a = projection_.project(from), b = projection_.project(to);
        if (a.z < least_depth_ && b.z < least_depth_)
            return;
        if (a.z < least_depth_) // the part in front of the camera: what is projected is linear in the point
            a = glm::mix(b, a, (b.z - least_depth_) / (b.z - a.z));
        else if (b.z < least_depth_)
            b = glm::mix(a, b, (a.z - least_depth_) / (a.z - b.z));
        ImGui::GetWindowDrawList()->AddLine(on_screen(a), on_screen(b), colour, width);
    }
    void outlined_line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const {
        line(from, to, shadow_colour, width + 2);
        line(from, to, colour, width);
    }
    void point(glm::vec3 p, ImU32 colour, float radius) const {
        const glm::vec3 seen = projection_.project(p);
        if (seen.z < least_depth_)
            return;
        ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius + 1, shadow_colour, 12);
        ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius, colour, 12);
    }
    void name(glm::vec3 p, const std::string& text) const {
        const glm::vec3 seen = projection_.project(p);
        if (seen.z < least_depth_)
            return;
        const ImVec2 at = on_screen(seen);
        const float gap = ImGui::GetFontSize() * 0.35f;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddText({at.x + gap + 1, at.y + gap + 1}, shadow_colour, text.c_str());
        list.AddText({at.x + gap, at.y + gap}, base_colour, text.c_str());
    }

private:
    ImVec2 on_screen(glm::vec3 projected) const {
        const glm::vec2 p = frame_.to_screen(glm::vec2(projected) / projected.z / glm::vec2(size_));
        return {p.x, p.y};
    }

    const PictureFrame& frame_;
    Projection projection_;
    glm::ivec2 size_;
    float least_depth_;
};

void mark_pixel(const PictureFrame& frame, glm::ivec2 pixel, glm::ivec2 size, ImU32 colour) {
    const glm::vec2 a = frame.to_screen(glm::vec2(pixel) / glm::vec2(size));
    const glm::vec2 b = frame.to_screen(glm::vec2(pixel + 1) / glm::vec2(size));
    const float least = ImGui::GetFontSize() * 0.3f, grow = std::max((least - (b.x - a.x)) * 0.5f, 0.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect({a.x - grow - 1, a.y - grow - 1}, {b.x + grow + 1, b.y + grow + 1}, shadow_colour);
    list.AddRect({a.x - grow, a.y - grow}, {b.x + grow, b.y + grow}, colour);
}

/// `share` of the pixel's light decides how plain it is.
void draw_shift(const SceneLines& lines, const InspectedShift& shift, float share, bool marked) {
    if (shift.offset.empty())
        return;
    const float font = ImGui::GetFontSize(), width = marked ? font * 0.2f : font * 0.09f;
    const ImU32 colour = with_alpha(colour_of(shift), marked ? 1 : 0.35f + 0.65f * share);
    for (std::size_t i = 0; i + 1 < shift.offset.size(); ++i)
        lines.line(shift.offset[i], shift.offset[i + 1], colour, width);
    if (!shift.beyond.empty())
        lines.line(shift.offset.back(), shift.beyond.front(), colour, width);
    for (std::size_t i = 0; i + 1 < shift.beyond.size(); ++i)
        lines.line(shift.beyond[i], shift.beyond[i + 1], with_alpha(colour, marked ? 1 : 0.2f + 0.4f * share),
                   width);
    for (glm::vec3 y : shift.offset)
        lines.point(y, colour, marked ? font * 0.25f : font * 0.14f);
}

void draw_shifts(const SceneLines& lines, const Inspector& inspector) {
    const std::vector<const InspectedShift*> shifts = shown_shifts(inspector);
    float most = 0;
    for (const InspectedShift* s : shifts)
        most = std::max(most, luminance(s->value));
    for (std::size_t i = 0; i < shifts.size(); ++i) {
        const float share = most > 0 ? luminance(shifts[i]->value) / most : 0;
        draw_shift(lines, *shifts[i], share, static_cast<int>(i) == inspector.marked);
    }
}

void draw_base_path(const SceneLines& lines, const Inspection& inspection, float scene_radius) {
    const float font = ImGui::GetFontSize();
    const auto& path = inspection.path;
    for (const InspectedVertex& x : path)
        for (glm::vec3 light : x.light_points) {
            lines.line(x.position, light, light_colour, font * 0.09f);
            lines.point(light, light_colour, font * 0.15f);
        }
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i + 1 < path.size())
            lines.outlined_line(path[i].position, path[i + 1].position, base_colour, font * 0.14f);
        else if (path[i].goes_on)
            lines.outlined_line(path[i].position, path[i].position + 0.5f * scene_radius * path[i].to_next,
                                light_colour, font * 0.14f);
    }
    for (std::size_t i = 0; i < path.size(); ++i) {
        lines.point(path[i].position, base_colour, font * 0.22f);
        lines.name(path[i].position, "x" + std::to_string(i + 1));
    }
}

} // namespace

ImU32 outcome_colour(ShiftOutcome outcome) {
    switch (outcome) {
    case ShiftOutcome::ok:
        return IM_COL32(72, 214, 140, 255);
    case ShiftOutcome::occluded:
        return IM_COL32(255, 84, 84, 255);
    case ShiftOutcome::kind_mismatch:
        return IM_COL32(255, 160, 60, 255);
    case ShiftOutcome::total_reflection:
        return IM_COL32(190, 120, 255, 255);
    case ShiftOutcome::outside:
        return IM_COL32(90, 160, 255, 255);
    case ShiftOutcome::no_light:
    case ShiftOutcome::count:
        break;
    }
    return IM_COL32(150, 150, 158, 255);
}

std::vector<const InspectedShift*> shown_shifts(const Inspector& inspector) {
    std::vector<const InspectedShift*> shifts;
    for (const InspectedSet& set : inspector.inspection->sets)
        for (const InspectedShift& s :
             inspector.direction == Inspector::Direction::to_pixel ? set.to_k : set.from_k)
            shifts.push_back(&s);
    return shifts;
}

void draw_inspected_paths(const PictureFrame& frame, const ScreenRect& clip, int pane, const ViewerState& state) {
    const Inspector& inspector = state.inspector;
    if (!inspector.active || !inspector.sample || !state.scene)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({clip.min.x, clip.min.y}, {clip.max.x, clip.max.y}, true);
    const bool is_shown = inspector.inspection && pane == inspector.pane &&
                          pane < static_cast<int>(state.panes.size()) &&
                          inspector.generation == state.panes[static_cast<std::size_t>(pane)].generation;
    if (is_shown) {
        const SceneLines lines(frame, state.camera.camera(), inspector.inspection->size,
                               1e-4f * state.scene->radius());
        draw_shifts(lines, inspector);
        draw_base_path(lines, *inspector.inspection, state.scene->radius());
    }
    mark_pixel(frame, inspector.sample->pixel, state.request_size(), colours::overlay_accent);
    list.PopClipRect();
}

} // namespace tessera
