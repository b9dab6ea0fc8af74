#include "ui/desktop.h"

#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>

namespace tessera {

glm::ivec2 on_screen(glm::ivec2 size) {
    glm::ivec2 corner(0), room(0);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
    return glm::max(room.x > 0 && room.y > 0 ? glm::min(size, room) : size, glm::ivec2(1));
}

bool is_on_a_screen(glm::ivec2 corner) {
    constexpr int grip = 64;
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return std::any_of(monitors, monitors + count, [&](GLFWmonitor* monitor) {
        glm::ivec2 at(0), room(0);
        glfwGetMonitorWorkarea(monitor, &at.x, &at.y, &room.x, &room.y);
        return corner.x >= at.x && corner.y >= at.y && corner.x + grip <= at.x + room.x &&
               corner.y + grip <= at.y + room.y;
    });
}

} // namespace tessera
