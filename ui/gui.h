#pragma once

#include "ui/theme.h"

#include <glm/vec2.hpp>

struct ImDrawData;
struct ImGuiContext;

namespace tessera {

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
    void set_look(float scale, Theme theme); ///< between frames

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
