#pragma once

#include <glm/vec3.hpp>

namespace tessera {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction; ///< unit
};

} // namespace tessera
