#pragma once

#include "recon/image.h"

#include <glm/mat3x3.hpp>

namespace tessera {

/// From the CIE's X, Y and Z of 1931 to linear sRGB [IEC 61966-2-1]; colours outside have negative components.
inline Rgb rgb_of_xyz(glm::vec3 xyz) {
    const glm::mat3 columns(3.240970f, -0.969244f, 0.055630f, -1.537383f, 1.875968f, -0.203977f, -0.498611f,
                            0.041555f, 1.056972f);
    return columns * xyz;
}

} // namespace tessera
