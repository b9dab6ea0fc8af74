#include "ui/window/desktop.h"

#include "ui/window/surface.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <glm/common.hpp>

namespace tessera {

glm::ivec2 on_screen(glm::ivec2 size) {
    glm::ivec2 corner(0), room(0);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
    return glm::max(room.x > 0 && room.y > 0 ? glm::min(size, room) : size, glm::ivec2(1));
}

bool is_on_a_screen(glm::ivec2 corner) {
    constexpr int reachable = 64; // screen units that must be visible
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return std::any_of(monitors, monitors + count, [&](GLFWmonitor* monitor) {
        glm::ivec2 at(0), room(0);
        glfwGetMonitorWorkarea(monitor, &at.x, &at.y, &room.x, &room.y);
        return corner.x >= at.x && corner.y >= at.y && corner.x + reachable <= at.x + room.x &&
               corner.y + reachable <= at.y + room.y;
    });
}

namespace {

thread_local const std::function<void()>* last_call = nullptr;

int end_process(void*) {
    std::fprintf(stderr, "The connection to the display is lost. The viewer exits.\n");
    if (last_call && *last_call)
        (*last_call)();
    std::_Exit(display_lost);
}

} // namespace

void watch_display() {
    using Handler = int (*)(void*);
    void* xlib = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD); // loaded by GLFW if it uses X
    if (void* set = xlib ? dlsym(xlib, "XSetIOErrorHandler") : nullptr)
        reinterpret_cast<Handler (*)(Handler)>(set)(end_process);
}

DisplayLossHandler::DisplayLossHandler(const std::function<void()>& last) {
    last_call = &last;
}

DisplayLossHandler::~DisplayLossHandler() {
    last_call = nullptr;
}

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
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
        return Key::enter;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
        return Key::shift;
    default:
        return Key::none;
    }
}

const char* key_label(int key, int scancode) {
    return key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2 ? glfwGetKeyName(key, scancode) : nullptr;
}

} // namespace tessera
