#pragma once

#include "ui/state/actions.h"

#include <functional>

#include <glm/vec2.hpp>

namespace tessera {

/// The size, as far as the first screen has room for it; >= 1x1.
glm::ivec2 on_screen(glm::ivec2 size);

/// Whether a window with this corner can be got hold of: its screen may have been taken away.
bool is_on_a_screen(glm::ivec2 corner);

/// Xlib ends the process when the connection to its server breaks, under the threads that still render. Makes that
/// end a quiet one, with a message and the exit code display_lost, where the windows are those of X. To be called
/// once there is a display.
void watch_display();

/// While one lives, a lost display calls `last` first, if it is noticed by the thread that made this one. Calls to
/// Xlib come from the thread that draws, now and then from another that wakes it.
class LastCall {
public:
    explicit LastCall(const std::function<void()>& last);
    ~LastCall();
    LastCall(const LastCall&) = delete;
    LastCall& operator=(const LastCall&) = delete;
};

/// The key that GLFW names by a code of its own (GLFW_KEY_...); none: the viewer has no use for it.
Key key_of_glfw(int key);

/// What is printed on a key, in the keyboard's own layout; null: nothing is. GLFW's own letters and digits are
/// places on an American keyboard.
const char* printed_on(int key, int scancode);

} // namespace tessera
