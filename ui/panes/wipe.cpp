#include "ui/gl/theme.h"
#include "ui/panes/pane_parts.h"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr float grab_ems = 0.9f; // distance at which the mouse grabs the line, font sizes

float line_x(const PictureFrame& frame, float wipe) {
    return std::floor(frame.rect.min.x + wipe * frame.rect.size().x);
}

/// Draws a name in a box.
/// @param align  0: right of x; 1: left of x; 0.5: centred at x
void draw_label(const PictureFrame& frame, float x, float align, const Showing& showing,
                const ViewerState& state) {
    const std::string text = label_of(showing, state);
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.4f), bar = std::floor(font * 0.25f);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float width = size.x + 3 * pad + bar, gap = font * (0.5f - align);
    const ImVec2 min(std::floor(x + gap - align * width), frame.rect.min.y + pad);
    const ImVec2 max(min.x + width, min.y + size.y + pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, colours::overlay, pad * 0.5f);
    const ImU32 colour = showing.pane == the_reference
                             ? colours::overlay_dim_text
                             : method_colour(state.panes[showing.pane].settings.render.method);
    list.AddRectFilled({min.x + pad, min.y + pad * 0.5f}, {min.x + pad + bar, max.y - pad * 0.5f}, colour);
    list.AddText({min.x + 2 * pad + bar, min.y + pad * 0.5f}, colours::overlay_text, text.c_str());
}

void draw_line(const PictureFrame& frame, float x) {
    const float font = ImGui::GetFontSize(), thickness = std::max(std::floor(font / 8), 1.0f);
    const float middle = (frame.rect.min.y + frame.rect.max.y) * 0.5f, reach = font * 0.8f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({x, frame.rect.min.y}, {x, frame.rect.max.y}, IM_COL32(0, 0, 0, 160), thickness + 2);
    list.AddLine({x, frame.rect.min.y}, {x, frame.rect.max.y}, IM_COL32(255, 255, 255, 230), thickness);
    list.AddCircleFilled({x, middle}, reach, colours::overlay);
    list.AddCircle({x, middle}, reach, IM_COL32(255, 255, 255, 230), 0, thickness);
    for (const float side : {-1.0f, 1.0f}) {
        const float tip = x + side * reach * 0.7f, back = x + side * reach * 0.25f;
        list.AddTriangleFilled({tip, middle}, {back, middle - reach * 0.4f}, {back, middle + reach * 0.4f},
                               IM_COL32(255, 255, 255, 230));
    }
}

void note_line(const PictureFrame& frame, float x, const std::string& id, Controls& controls) {
    const float reach = grab_ems * ImGui::GetFontSize();
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({x - reach, frame.rect.min.y});
    ImGui::Dummy({2 * reach, std::max(frame.rect.size().y, 1.0f)});
    controls.place(
        (id + ".wipe").c_str(),
        "Drag the line. This pane's own picture is on the left, the compared one on the right (V switches "
        "the wipe).");
    ImGui::SetCursorScreenPos(cursor);
}

} // namespace

bool is_on_wipe(const PictureFrame& frame, float wipe, glm::vec2 point) {
    return frame.rect.contains(point) &&
           std::abs(point.x - line_x(frame, wipe)) <= grab_ems * ImGui::GetFontSize();
}

void draw_comparison(const PictureFrame& frame, const std::string& id, int pane, const ViewerState& state,
                     Controls& controls) {
    const Sides sides = sides_of(state, pane);
    if (sides.left == Showing{pane} && !sides.divided())
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({frame.rect.min.x, frame.rect.min.y}, {frame.rect.max.x, frame.rect.max.y}, true);
    if (!sides.divided()) {
        draw_label(frame, (frame.rect.min.x + frame.rect.max.x) * 0.5f, 0.5f, sides.left, state);
    } else {
        const float x = line_x(frame, state.layout.wipe);
        draw_label(frame, x, 1, sides.left, state);
        draw_label(frame, x, 0, sides.right, state);
        draw_line(frame, x);
        note_line(frame, x, id, controls);
    }
    list.PopClipRect();
}

} // namespace tessera
