#pragma once

#include "ui/keyboard.h"

namespace tessera {

/// The key that GLFW names by a code of its own (GLFW_KEY_...); none: the viewer has no use for it.
Key key_of_glfw(int key);

/// What is printed on a key, in the keyboard's own layout; null: nothing is. GLFW's own letters and digits are
/// places on an American keyboard.
const char* printed_on(int key, int scancode);

} // namespace tessera
