#include "ui/scene_lines.h"

#include <algorithm>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr ImU32 shadow_colour = IM_COL32(0, 0, 0, 150);

} // namespace

ImU32 with_alpha(ImU32 colour, float alpha) {
    const auto bits = static_cast<ImU32>(std::clamp(alpha, 0.0f, 1.0f) * 255);
    return (colour & ~IM_COL32_A_MASK) | (bits << IM_COL32_A_SHIFT);
}

SceneLines::SceneLines(const PictureFrame& frame, const Camera& camera, glm::ivec2 size, float least_depth)
    : frame_(frame), projection_(camera, size), size_(size), least_depth_(least_depth) {}

void SceneLines::line(glm::vec3 from, glm::vec3 to, ImU32 colour, float width) const {
    glm::vec3 a = projection_.project(from), b = projection_.project(to);
    if (a.z < least_depth_ && b.z < least_depth_)
        return;
    if (a.z < least_depth_) // the part in front of the camera: what is projected is linear in the point
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
    const glm::vec3 seen = projection_.project(p);
    if (seen.z < least_depth_)
        return;
    ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius + 1, shadow_colour, 12);
    ImGui::GetWindowDrawList()->AddCircleFilled(on_screen(seen), radius, colour, 12);
}

void SceneLines::dot(glm::vec3 p, ImU32 colour, float width) const {
    const glm::vec3 seen = projection_.project(p);
    if (seen.z < least_depth_)
        return;
    const ImVec2 at = on_screen(seen);
    const float half = width * 0.5f;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, colour);
}

void SceneLines::name(glm::vec3 p, const std::string& text, ImU32 colour) const {
    const glm::vec3 seen = projection_.project(p);
    if (seen.z < least_depth_)
        return;
    const ImVec2 at = on_screen(seen);
    const float gap = ImGui::GetFontSize() * 0.35f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const ImVec2 by : {ImVec2(1, 1), ImVec2(-1, 0), ImVec2(1, -1), ImVec2(0, 1)})
        list.AddText({at.x + gap + by.x, at.y + gap + by.y}, shadow_colour, text.c_str());
    list.AddText({at.x + gap, at.y + gap}, colour, text.c_str());
}

ImVec2 SceneLines::on_screen(glm::vec3 projected) const {
    const glm::vec2 p = frame_.to_screen(glm::vec2(projected) / projected.z / glm::vec2(size_));
    return {p.x, p.y};
}

} // namespace tessera
