#include "ui/path_drawing.h"

#include <algorithm>

namespace tessera {

namespace {

constexpr ImU32 base_colour = IM_COL32(255, 255, 255, 255), light_colour = IM_COL32(255, 226, 92, 200);
constexpr ImU32 untried_colour = IM_COL32(150, 150, 150, 255);

/// `share` of the light decides how plain it is.
void draw_shift(const SceneLines& lines, const InspectedShift& shift, float share, bool marked) {
    if (shift.offset.empty())
        return;
    const float font = ImGui::GetFontSize(), width = marked ? font * 0.2f : font * 0.09f;
    const ImU32 colour = with_alpha(outcome_colour(shift), marked ? 1 : 0.35f + 0.65f * share);
    for (std::size_t i = 0; i + 1 < shift.offset.size(); ++i)
        lines.line(shift.offset[i], shift.offset[i + 1], colour, width);
    if (!shift.beyond.empty())
        lines.line(shift.offset.back(), shift.beyond.front(), colour, width);
    for (std::size_t i = 0; i + 1 < shift.beyond.size(); ++i)
        lines.line(shift.beyond[i], shift.beyond[i + 1], with_alpha(colour, marked ? 1 : 0.2f + 0.4f * share),
                   width);
    for (glm::vec3 y : shift.offset) // circles for hundreds of them would take a software driver most of its time
        marked ? lines.point(y, colour, font * 0.25f) : lines.dot(y, colour, font * 0.25f);
}

} // namespace

ImU32 outcome_colour(const InspectedShift& shift) {
    return shift.is_tried ? outcome_colour(shift.outcome) : untried_colour;
}

void draw_shifts(const SceneLines& lines, const std::vector<const InspectedShift*>& shifts, int marked) {
    float most = 0;
    for (const InspectedShift* s : shifts)
        most = std::max(most, luminance(s->value));
    for (std::size_t i = 0; i < shifts.size(); ++i)
        if (static_cast<int>(i) != marked)
            draw_shift(lines, *shifts[i], most > 0 ? luminance(shifts[i]->value) / most : 0, false);
    if (marked >= 0 && marked < static_cast<int>(shifts.size()))
        draw_shift(lines, *shifts[static_cast<std::size_t>(marked)], 1, true);
}

void draw_base_path(const SceneLines& lines, const std::vector<InspectedVertex>& path, float far) {
    const float font = ImGui::GetFontSize();
    for (const InspectedVertex& x : path)
        for (glm::vec3 light : x.light_points) {
            lines.line(x.position, light, light_colour, font * 0.09f);
            lines.point(light, light_colour, font * 0.15f);
        }
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i + 1 < path.size())
            lines.outlined_line(path[i].position, path[i + 1].position, base_colour, font * 0.14f);
        else if (path[i].goes_on)
            lines.outlined_line(path[i].position, path[i].position + far * path[i].to_next, light_colour,
                                font * 0.14f);
    }
    for (std::size_t i = 0; i < path.size(); ++i) {
        lines.point(path[i].position, base_colour, font * 0.22f);
        lines.name(path[i].position, "x" + std::to_string(i + 1), base_colour);
    }
}

} // namespace tessera
