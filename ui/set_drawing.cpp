#include "ui/set_drawing.h"

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
        return m >= 0 && (set.is_border[static_cast<std::size_t>(m)] != 0) == border;
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

void SetDrawing::arrow(glm::ivec2 from, glm::ivec2 to, float share, ImU32 colour, float width) const {
    const ImVec2 a = middle(from), end = middle(to);
    const glm::vec2 way(end.x - a.x, end.y - a.y), tip = glm::vec2(a.x, a.y) + way * share;
    const float head = std::min(unit() * 0.22f, ImGui::GetFontSize() * 0.45f);
    const glm::vec2 ahead = way / std::max(glm::length(way), 1e-3f), aside(-ahead.y, ahead.x);
    const glm::vec2 foot = tip - ahead * head, left = foot + aside * (head * 0.5f),
                    right = foot - aside * (head * 0.5f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(a, {foot.x, foot.y}, colour, width);
    list.AddTriangleFilled({tip.x, tip.y}, {left.x, left.y}, {right.x, right.y}, colour);
}

} // namespace tessera
