#pragma once

#include "ui/gl/theme.h"

#include <array>
#include <optional>

#include <glm/vec2.hpp>
#include <imgui.h>

struct ImDrawData;
struct ImGuiContext;

namespace tessera {

// Everything that differs between the supported versions of Dear ImGui (1.86 of Debian 12 to 1.90 of Debian 13) is
// here and in gui.cpp. Keys are not read from Dear ImGui; see Keyboard.

ImTextureID texture_id(unsigned opengl_name);

/// Positions of the mouse at which the window saw buttons go down, by button; none for clicks of scripts.
using PressPositions = std::array<std::optional<glm::vec2>, 3>;

/// Tells Dear ImGui these positions for the clicks of the frame that has begun, and clears them.
void apply_press_positions(PressPositions& by_button);

/// Input that does not come from a window, for the next frame.
void send_mouse_position(ImVec2 position);
void send_mouse_button(ImGuiMouseButton button, bool down);
void send_mouse_wheel(float up);
/// A navigation step within an open list or menu.
enum class ListStep { left, right, up, down, take, close };
/// Queues a step. Each step has its own frames, since Dear ImGui samples held keys when a frame begins.
void send_list_step(ListStep step);
/// Returns whether queued steps remain, so that frames are due.
bool list_steps_pending();

void send_modifiers(bool ctrl, bool shift);

/// One context of Dear ImGui on the current OpenGL context, without a window, with its fonts and OpenGL backend.
/// OpenGL must be loaded (gladLoadGL), and current for the lifetime of this object.
class Gui {
public:
    /// @param scale  of the display, 0.5 to 4. Throws std::runtime_error if OpenGL fails.
    explicit Gui(float scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    float scale() const { return scale_; }
    /// Sets fonts, spacing and colours for the next frames.
    void set_style(float scale, Theme theme); ///< between frames

    /// Begins a frame of `size` screen units, `pixels_a_unit` framebuffer pixels each, `seconds` after the last.
    /// For a surface without a window; a window's backend sets these itself (begin_window_frame).
    void begin_frame(glm::vec2 size, float pixels_a_unit, float seconds);
    /// Begins a frame whose size and input come from a window's backend.
    void begin_window_frame();
    /// Ends the frame and draws it over the whole bound framebuffer.
    void end_frame();

private:
    ImGuiContext* context_ = nullptr;
    float scale_ = 1;
    Theme theme_ = Theme::dark;
};

/// Draws a frame over the whole bound framebuffer, with the OpenGL backend of the current context. The frame may
/// come from another context with the same fonts.
void draw_over_all(ImDrawData& frame);

} // namespace tessera
