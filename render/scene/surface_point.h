#pragma once

#include "recon/image.h"

#include <glm/vec2.hpp>

namespace tessera {

/// Where on a surface a texture is looked up.
struct SurfacePoint {
    glm::vec2 uv{0};
    Rgb vertex_color{1}; ///< of a mesh that has such, interpolated
};

} // namespace tessera
