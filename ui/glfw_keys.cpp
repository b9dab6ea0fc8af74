#include "ui/glfw_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace tessera {

Key key_of_glfw(int key) {
    if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
        return key_of_character(static_cast<char>('a' + key - GLFW_KEY_A));
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)
        return key_of_character(static_cast<char>('0' + key - GLFW_KEY_0));
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return static_cast<Key>(static_cast<int>(Key::f1) + key - GLFW_KEY_F1);
    switch (key) {
    case GLFW_KEY_LEFT:
        return Key::left;
    case GLFW_KEY_RIGHT:
        return Key::right;
    case GLFW_KEY_UP:
        return Key::up;
    case GLFW_KEY_DOWN:
        return Key::down;
    case GLFW_KEY_HOME:
        return Key::home;
    case GLFW_KEY_SPACE:
        return Key::space;
    case GLFW_KEY_TAB:
        return Key::tab;
    case GLFW_KEY_ESCAPE:
        return Key::escape;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
        return Key::shift;
    default:
        return Key::none;
    }
}

const char* printed_on(int key, int scancode) {
    return key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2 ? glfwGetKeyName(key, scancode) : nullptr;
}

} // namespace tessera
