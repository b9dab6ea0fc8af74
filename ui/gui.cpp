#include "ui/gui.h"

#include "ui/theme.h"

#include <algorithm>
#include <stdexcept>

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

namespace tessera {

namespace {
float sane_scale(float scale) {
    return scale > 0 ? std::clamp(scale, 0.5f, 4.0f) : 1.0f;
}
} // namespace

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

void Gui::set_look(float scale, Theme theme) {
    if (sane_scale(scale) == scale_ && theme == theme_)
        return;
    scale_ = sane_scale(scale);
    theme_ = theme;
    // The fonts' texture alone: 1.86 forgets to forget the size of the buffers that ...DestroyDeviceObjects
    // deletes, and draws nothing from then on.
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
