#include "ui/mouse_input.h"

#include <imgui.h>

namespace tessera {

glm::vec2 mouse_position() {
    return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
}

glm::vec2 grab_position() {
    const ImGuiIO& io = ImGui::GetIO();
    for (int button = 0; button < 3; ++button)
        if (ImGui::IsMouseClicked(button))
            return {io.MouseClickedPos[button].x, io.MouseClickedPos[button].y};
    return mouse_position();
}

PaneMouse read_mouse(const PictureFrame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    PaneMouse mouse;
    const glm::vec2 before = ImGui::IsItemActivated()
                                 ? grab_position()
                                 : mouse_position() - glm::vec2(io.MouseDelta.x, io.MouseDelta.y);
    mouse.position = (mouse_position() - frame.rect.min) * frame.pixels_a_unit;
    mouse.previous = (before - frame.rect.min) * frame.pixels_a_unit;
    const bool active = ImGui::IsItemActive();
    mouse.left = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    mouse.middle = active && ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    mouse.right = active && ImGui::IsMouseDown(ImGuiMouseButton_Right);
    mouse.wheel = ImGui::IsItemHovered() ? io.MouseWheel : 0.0f;
    mouse.ctrl = io.KeyCtrl;
    mouse.shift = io.KeyShift;
    return mouse;
}

} // namespace tessera
