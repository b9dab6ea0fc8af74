#include "ui/imgui_version.h"

#include <cstdint>

namespace tessera {

ImTextureID texture_id(unsigned opengl_name) {
#if IMGUI_VERSION_NUM >= 19131
    return static_cast<ImTextureID>(opengl_name);
#else
    return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(opengl_name));
#endif
}

void set_press_positions(const std::array<glm::vec2, 3>& by_button) {
    ImGuiIO& io = ImGui::GetIO();
    for (std::size_t i = 0; i < by_button.size(); ++i)
        if (io.MouseClicked[i])
            io.MouseClickedPos[i] = {by_button[i].x, by_button[i].y};
}

#if IMGUI_VERSION_NUM >= 18700

void send_mouse_position(ImVec2 position) {
    ImGui::GetIO().AddMousePosEvent(position.x, position.y);
}
void send_mouse_button(ImGuiMouseButton button, bool down) {
    ImGui::GetIO().AddMouseButtonEvent(button, down);
}
void send_mouse_wheel(float up) {
    ImGui::GetIO().AddMouseWheelEvent(0.0f, up);
}

void send_modifiers(bool ctrl, bool shift) {
#if IMGUI_VERSION_NUM >= 18900
    constexpr ImGuiKey ctrl_key = ImGuiMod_Ctrl, shift_key = ImGuiMod_Shift;
#else
    constexpr ImGuiKey ctrl_key = ImGuiKey_ModCtrl, shift_key = ImGuiKey_ModShift;
#endif
    ImGui::GetIO().AddKeyEvent(ctrl_key, ctrl);
    ImGui::GetIO().AddKeyEvent(shift_key, shift);
}

#else

void send_mouse_position(ImVec2 position) {
    ImGui::GetIO().MousePos = position;
}
void send_mouse_button(ImGuiMouseButton button, bool down) {
    ImGui::GetIO().MouseDown[button] = down;
}
void send_mouse_wheel(float up) {
    ImGui::GetIO().MouseWheel += up;
}

void send_modifiers(bool ctrl, bool shift) {
    ImGui::GetIO().KeyCtrl = ctrl;
    ImGui::GetIO().KeyShift = shift;
}

#endif

} // namespace tessera
