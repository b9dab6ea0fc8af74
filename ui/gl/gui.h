#pragma once

#include "ui/gl/theme.h"

#include <array>
#include <optional>

#include <glm/vec2.hpp>
#include <imgui.h>

struct ImDrawData;
struct ImGuiContext;

namespace tessera {

/// What differs between the versions of Dear ImGui that the viewer compiles with (1.86 of Debian 12 to 1.90 of
/// Debian 13) stands here and in gui.cpp, nowhere else. Keys are not read from Dear ImGui at all: see
/// Keyboard.

ImTextureID texture_id(unsigned opengl_name);

/// Where the window saw buttons of the mouse go down, by button: none where it saw nothing, as with a script's.
using PressPositions = std::array<std::optional<glm::vec2>, 3>;

/// Says so of those that went down, in a frame that has begun, and empties them.
void tell_press_positions(PressPositions& by_button);

/// Input from elsewhere than a window: seen by the next frame.
void send_mouse_position(ImVec2 position);
void send_mouse_button(ImGuiMouseButton button, bool down);
void send_mouse_wheel(float up);
/// A step within an open list or menu.
enum class ListStep { left, right, up, down, take, close };
/// Steps come one after the other, each with a frame of its own: Dear ImGui looks at what is held when one begins.
void send_list_step(ListStep step);
/// Whether steps are still to come, so that frames are due.
bool list_steps_pending();

void send_modifiers(bool ctrl, bool shift);

/// Dear ImGui on the current OpenGL context, without a window: one context, its fonts, and its OpenGL backend.
/// OpenGL must be loaded (gladLoadGL) and current for as long as this lives.
class Gui {
public:
    /// `scale` of the display, 1 to 3. Throws std::runtime_error if OpenGL refuses.
    explicit Gui(float scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    float scale() const { return scale_; }
    /// Text, spaces and colours of what is drawn from the next frame on.
    void set_style(float scale, Theme theme); ///< between frames

    /// Begins a frame of `size` screen units, `pixels_a_unit` framebuffer pixels each, `seconds` after the last.
    /// For a drawing place without a window; a window's backend sets these itself (begin_window_frame).
    void begin_frame(glm::vec2 size, float pixels_a_unit, float seconds);
    /// Begins a frame whose size and input a window's backend has set.
    void begin_window_frame();
    /// Ends the frame and draws it over the whole of the framebuffer bound.
    void end_frame();

private:
    ImGuiContext* context_ = nullptr;
    float scale_ = 1;
    Theme theme_ = Theme::dark;
};

/// Draws a frame over the whole of the framebuffer bound, with the OpenGL backend of Dear ImGui's current context;
/// the frame may be another's that has the same fonts.
void draw_over_all(ImDrawData& frame);

} // namespace tessera
