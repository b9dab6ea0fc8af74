#include "ui/inside/drawing.h"

#include "render/inspect/inspection.h"
#include "ui/state/inspected.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

float SetDrawing::unit() const {
    return frame_.placement.extent.x / frame_.pixels_a_unit / static_cast<float>(size_.x);
}

ImVec2 SetDrawing::corner(glm::ivec2 pixel) const {
    const glm::vec2 p = frame_.to_screen(glm::vec2(pixel) / glm::vec2(size_));
    return {std::floor(p.x), std::floor(p.y)};
}

ImVec2 SetDrawing::middle(glm::ivec2 pixel) const {
    const glm::vec2 p = frame_.to_screen((glm::vec2(pixel) + 0.5f) / glm::vec2(size_));
    return {p.x, p.y};
}

void SetDrawing::fill(glm::ivec2 pixel, ImU32 colour) const {
    ImGui::GetWindowDrawList()->AddRectFilled(corner(pixel), corner(pixel + 1), colour);
}

void SetDrawing::fill(PixelRect rect, ImU32 colour) const {
    if (!rect.empty())
        ImGui::GetWindowDrawList()->AddRectFilled(corner({rect.x0, rect.y0}), corner({rect.x1, rect.y1}), colour);
}

void SetDrawing::frame(glm::ivec2 pixel, ImU32 colour, float width) const {
    const ImVec2 a = corner(pixel), b = corner(pixel + 1);
    const float in = width * 0.5f;
    ImGui::GetWindowDrawList()->AddRect({a.x + in, a.y + in}, {b.x - in, b.y - in}, colour, 0, 0, width);
}

void SetDrawing::outline(PixelRect rect, ImU32 colour, float width) const {
    ImGui::GetWindowDrawList()->AddRect(corner({rect.x0, rect.y0}), corner({rect.x1, rect.y1}), colour, 0, 0,
                                        width);
}

void SetDrawing::outline(const InspectedSet& set, bool border, ImU32 colour, float width) const {
    const auto belongs = [&](glm::ivec2 p) {
        const int m = set.index_of(p);
        return m >= 0 && (set.is_border[m] != 0) == border;
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (glm::ivec2 p : set.pixels) {
        if (!belongs(p))
            continue;
        const ImVec2 a = corner(p), b = corner(p + 1);
        if (!belongs(p - glm::ivec2(1, 0)))
            list.AddLine({a.x, a.y}, {a.x, b.y}, colour, width);
        if (!belongs(p + glm::ivec2(1, 0)))
            list.AddLine({b.x, a.y}, {b.x, b.y}, colour, width);
        if (!belongs(p - glm::ivec2(0, 1)))
            list.AddLine({a.x, a.y}, {b.x, a.y}, colour, width);
        if (!belongs(p + glm::ivec2(0, 1)))
            list.AddLine({a.x, b.y}, {b.x, b.y}, colour, width);
    }
}

void SetDrawing::arrow(glm::ivec2 from, glm::ivec2 to, float fraction, ImU32 colour, float width) const {
    const ImVec2 a = middle(from), end = middle(to);
    const glm::vec2 way(end.x - a.x, end.y - a.y), tip = glm::vec2(a.x, a.y) + way * fraction;
    const float head = std::min(unit() * 0.22f, ImGui::GetFontSize() * 0.45f);
    const glm::vec2 ahead = way / std::max(glm::length(way), 1e-3f), aside(-ahead.y, ahead.x);
    const glm::vec2 foot = tip - ahead * head, left = foot + aside * (head * 0.5f),
                    right = foot - aside * (head * 0.5f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(a, {foot.x, foot.y}, colour, width);
    list.AddTriangleFilled({tip.x, tip.y}, {left.x, left.y}, {right.x, right.y}, colour);
}

namespace {

constexpr ImU32 shadow_colour = IM_COL32(0, 0, 0, 150);

} // namespace

SceneLines::SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth,
                       glm::vec2 lens)
    : frame_(frame), projection_(camera, size), size_(size), least_depth_(least_depth), lens_(lens) {}

void SceneLines::line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const {
    glm::vec4 a = project(from), b = project(to);
    if (a.z < least_depth_ && b.z < least_depth_)
        return;
    if (a.z <
        least_depth_) // clips to the part in front of the camera: projection is linear in homogeneous coordinates
        a = glm::mix(b, a, (b.z - least_depth_) / (b.z - a.z));
    else if (b.z < least_depth_)
        b = glm::mix(a, b, (a.z - least_depth_) / (a.z - b.z));
    ImGui::GetWindowDrawList()->AddLine(on_screen(a), on_screen(b), colour, width);
}

void SceneLines::outlined_line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const {
    line(from, to, shadow_colour, width + 2);
    line(from, to, colour, width);
}

void SceneLines::point(glm::vec3 p, ImU32 colour, float radius) const {
    const glm::vec4 seen = project(p);
    if (seen.z < least_depth_)
        return;
    ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius + 1, shadow_colour, 12);
    ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius, colour, 12);
}

void SceneLines::dot(glm::vec3 p, ImU32 colour, float width) const {
    const glm::vec4 seen = project(p);
    if (seen.z < least_depth_)
        return;
    const ImVec2 at = on_screen(seen);
    const float half = width * 0.5f;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, colour);
}

void SceneLines::name(glm::vec3 p, const std::string& text, ImU32 colour) const {
    const glm::vec4 seen = project(p);
    if (seen.z < least_depth_)
        return;
    const ImVec2 at = on_screen(seen);
    const float gap = ImGui::GetFontSize() * 0.35f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const ImVec2 by : {ImVec2(1, 1), ImVec2(-1, 0), ImVec2(1, -1), ImVec2(0, 1)})
        list.AddText({at.x + gap + by.x, at.y + gap + by.y}, shadow_colour, text.c_str());
    list.AddText({at.x + gap, at.y + gap}, colour, text.c_str());
}

ImVec2 SceneLines::on_screen(glm::vec4 projected) const {
    const glm::vec2 p = frame_.to_screen(glm::vec2(projected) / projected.w / glm::vec2(size_));
    return {p.x, p.y};
}

namespace {

constexpr ImU32 base_colour = IM_COL32(255, 255, 255, 255), light_colour = IM_COL32(255, 226, 92, 200),
                footprint_colour = IM_COL32(226, 130, 255, 230);
constexpr ImU32 untried_colour = IM_COL32(150, 150, 150, 255);

void draw_footprint(const SceneLines& lines, glm::vec3 middle, const Footprint& f, float width) {
    const glm::vec3 to_corner[] = {f.a + f.b, f.b - f.a, -f.a - f.b, f.a - f.b};
    for (int i = 0; i < 4; ++i)
        lines.outlined_line(middle + 0.5f * to_corner[i], middle + 0.5f * to_corner[(i + 1) % 4], footprint_colour,
                            width);
}

/// Draws one shift. Its opacity grows with `fraction`, its luminance relative to the brightest shift.
void draw_shift(const SceneLines& lines, const InspectedShift& shift, float fraction, bool marked) {
    if (shift.offset.empty())
        return;
    const float font = ImGui::GetFontSize(), width = marked ? font * 0.2f : font * 0.09f;
    const ImU32 colour = with_alpha(outcome_colour(shift), marked ? 1 : 0.35f + 0.65f * fraction);
    for (std::size_t i = 0; i + 1 < shift.offset.size(); ++i)
        lines.line(shift.offset[i], shift.offset[i + 1], colour, width);
    if (!shift.beyond.empty())
        lines.line(shift.offset.back(), shift.beyond.front(), colour, width);
    for (std::size_t i = 0; i + 1 < shift.beyond.size(); ++i)
        lines.line(shift.beyond[i], shift.beyond[i + 1], with_alpha(colour, marked ? 1 : 0.2f + 0.4f * fraction),
                   width);
    for (glm::vec3 y : shift.offset) // squares, since circles of hundreds of paths are slow in software drivers
        marked ? lines.point(y, colour, font * 0.25f) : lines.dot(y, colour, font * 0.25f);
    if (marked)
        for (const InspectedStep& step : shift.steps)
            if (step.footprint.area() > 0)
                draw_footprint(lines, step.vertex.position, step.footprint, font * 0.08f);
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
        if (x.footprint.area() > 0)
            draw_footprint(lines, x.position, x.footprint, font * 0.08f);
    for (const InspectedVertex& x : path)
        if (x.light) {
            lines.line(x.position, x.light->position, light_colour, font * 0.09f);
            lines.point(x.light->position, light_colour, font * 0.15f);
            if (x.light->footprint.area() > 0)
                draw_footprint(lines, x.light->position, x.light->footprint, font * 0.08f);
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
