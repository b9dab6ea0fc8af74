#pragma once

#include "recon/image.h"

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

enum class Scatter : std::uint8_t { reflect, transmit };

/// The non-delta part of a BSDF for two directions. Both are 0 where light cannot go that way.
struct BsdfValue {
    Rgb f_cos{0};    ///< f times |cos| of to_next, per solid angle
    float pdf_w = 0; ///< of sampling to_next from to_previous
};

/// The delta part of a BSDF of one kind (reflect or transmit).
struct DeltaValue {
    glm::vec3 to_next{0};  ///< the only direction
    Rgb value{0};          ///< the share of radiance that goes this way
    float probability = 0; ///< of choosing it; 0: there is no such part
};

/// A sampled direction. With is_delta, f_cos is a share and pdf_w a probability, as in DeltaValue.
struct BsdfSample {
    glm::vec3 to_next;
    Rgb f_cos;
    float pdf_w; ///< > 0
    bool is_delta;
    Scatter scatter;
};

/// Mirrors a direction on the normal of the shading frame.
inline glm::vec3 reflect(glm::vec3 d) {
    return {-d.x, -d.y, d.z};
}

/// Mirrors a direction, away from the surface, on a unit half vector.
inline glm::vec3 reflect(glm::vec3 d, glm::vec3 half) {
    return 2 * glm::dot(d, half) * half - d;
}

/// The half vector of a reflection, unit and on the upper side of the frame.
inline glm::vec3 half_vector(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 h = glm::normalize(a + b);
    return h.z < 0 ? -h : h;
}

} // namespace tessera
