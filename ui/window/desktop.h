#pragma once

#include "ui/state/actions.h"

#include <functional>

#include <glm/vec2.hpp>

namespace tessera {

/// Returns the size, limited to the work area of the primary screen; >= 1x1.
glm::ivec2 on_screen(glm::ivec2 size);

/// Returns whether a window with this corner can be reached: its screen may have been removed.
bool is_on_a_screen(glm::ivec2 corner);

/// Replaces the handler that Xlib calls when the connection to its server breaks. The process then ends with a
/// message and the exit code display_lost. Must be called once there is a display; does nothing without X.
void watch_display();

/// During its lifetime, a lost display calls `last` before the process ends, if the thread that created this
/// object notices the loss. Most calls to Xlib come from that drawing thread; another that wakes it may notice the
/// loss instead.
class DisplayLossHandler {
public:
    explicit DisplayLossHandler(const std::function<void()>& last);
    ~DisplayLossHandler();
    DisplayLossHandler(const DisplayLossHandler&) = delete;
    DisplayLossHandler& operator=(const DisplayLossHandler&) = delete;
};

/// Returns the key for a code of GLFW (GLFW_KEY_...); Key::none if the viewer does not use it.
Key key_of_glfw(int key);

/// Returns the character on a key in the keyboard's own layout; null: none. GLFW's own letters and digits name
/// positions on an American keyboard.
const char* key_label(int key, int scancode);

} // namespace tessera
