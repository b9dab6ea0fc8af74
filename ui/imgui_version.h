#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

/// What differs between the versions of Dear ImGui that the viewer compiles with (1.86 of Debian 12 to 1.90 of
/// Debian 13) stands here and in imgui_version.cpp, nowhere else. Keys are not read from Dear ImGui at all: see
/// keyboard.h.

ImTextureID texture_id(unsigned opengl_name);

/// In a frame that has begun: where the buttons of the mouse that went down did so.
void set_press_positions(const std::array<glm::vec2, 3>& by_button);

/// Input from elsewhere than a window: seen by the next frame.
void send_mouse_position(ImVec2 position);
void send_mouse_button(ImGuiMouseButton button, bool down);
void send_mouse_wheel(float up);
void send_modifiers(bool ctrl, bool shift);

} // namespace tessera
