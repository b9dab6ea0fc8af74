#include "ui/gl/gui.h"

#include "recon/enumeration.h"
#include "ui/gl/theme.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <stdexcept>

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

namespace tessera {

ImTextureID texture_id(unsigned opengl_name) {
#if IMGUI_VERSION_NUM >= 19131
    return static_cast<ImTextureID>(opengl_name);
#else
    return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(opengl_name));
#endif
}

void apply_press_positions(PressPositions& by_button) {
    ImGuiIO& io = ImGui::GetIO();
    for (std::size_t i = 0; i < by_button.size(); ++i)
        if (io.MouseClicked[i] && by_button[i]) {
            io.MouseClickedPos[i] = {by_button[i]->x, by_button[i]->y};
            by_button[i].reset();
        }
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

namespace {

std::deque<ListStep> list_steps;
bool step_is_down = false; // a step is released for one frame before the next

#if IMGUI_VERSION_NUM >= 18700

void hold(ListStep step, bool down) {
    constexpr ImGuiKey keys[] = {ImGuiKey_GamepadDpadLeft, ImGuiKey_GamepadDpadRight, ImGuiKey_GamepadDpadUp,
                                 ImGuiKey_GamepadDpadDown, ImGuiKey_GamepadFaceDown,  ImGuiKey_GamepadFaceRight};
    ImGui::GetIO().AddKeyEvent(entry_of(keys, step), down);
}

#else

void hold(ListStep step, bool down) { // Dear ImGui clears inputs in each frame
    constexpr int inputs[] = {ImGuiNavInput_DpadLeft, ImGuiNavInput_DpadRight, ImGuiNavInput_DpadUp,
                              ImGuiNavInput_DpadDown, ImGuiNavInput_Activate,  ImGuiNavInput_Cancel};
    ImGui::GetIO().NavInputs[entry_of(inputs, step)] = down ? 1.0f : 0.0f;
}

#endif

/// Presses or releases the next queued step, before a frame.
void do_list_step() {
    if (list_steps.empty())
        return;
    hold(list_steps.front(), !step_is_down);
    if (step_is_down)
        list_steps.pop_front();
    step_is_down = !step_is_down;
}

float sane_scale(float scale) {
    return scale > 0 ? std::clamp(scale, 0.5f, 4.0f) : 1.0f;
}
} // namespace

void send_list_step(ListStep step) {
    list_steps.push_back(step);
}

bool list_steps_pending() {
    return !list_steps.empty();
}

Gui::Gui(float scale) : scale_(sane_scale(scale)) {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    apply_theme(scale_, theme_);
    if (ImGui_ImplOpenGL3_Init("#version 330 core"))
        return;
    ImGui::DestroyContext(context_);
    throw std::runtime_error("Dear ImGui cannot draw on this OpenGL");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context_);
}

void Gui::set_style(float scale, Theme theme) {
    if (sane_scale(scale) == scale_ && theme == theme_)
        return;
    scale_ = sane_scale(scale);
    theme_ = theme;
    // Only the fonts' texture is recreated: after ...DestroyDeviceObjects, version 1.86 keeps the sizes of deleted
    // buffers and draws nothing.
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    apply_theme(scale_, theme_);
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::begin_frame(glm::vec2 size, float pixels_a_unit, float seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size.x, size.y};
    io.DisplayFramebufferScale = {pixels_a_unit, pixels_a_unit};
    io.DeltaTime = std::max(seconds, 1e-4f);
    begin_window_frame();
}

void Gui::begin_window_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    // Steps in lists are sent as gamepad input, since keys are not read from Dear ImGui. The window's backend
    // resets these flags in each frame.
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableGamepad;
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_HasGamepad;
    do_list_step();
    ImGui::NewFrame();
}

void Gui::end_frame() {
    ImGui::Render();
    draw_over_all(*ImGui::GetDrawData());
}

void draw_over_all(ImDrawData& frame) {
    glViewport(0, 0, static_cast<GLsizei>(frame.DisplaySize.x * frame.FramebufferScale.x),
               static_cast<GLsizei>(frame.DisplaySize.y * frame.FramebufferScale.y));
    glDisable(GL_SCISSOR_TEST);
    const ImVec4 background = ImGui::ColorConvertU32ToFloat4(colours::panel);
    glClearColor(background.x, background.y, background.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(&frame);
}

} // namespace tessera
