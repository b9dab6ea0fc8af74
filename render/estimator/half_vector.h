#pragma once

#include "render/estimator/tracer.h"

#include <optional>

#include <glm/vec3.hpp>

namespace tessera {

/// A scattering of a base path as it is done again at an offset vertex.
struct CopiedScatter {
    glm::vec3 to_next; ///< in the offset vertex's frame
    Rgb f_cos;
    float pdf_w;    ///< per solid angle, or a probability after a delta scatter
    float jacobian; ///< solid angle at the offset over solid angle at the base; 1 after a copied delta scatter
};

/// Copies the half vector of a reflection or, where base_to_next is on the other side, of a refraction from the
/// base's frame to the offset's [Kettunen 2015, 5.2; Jacobians from Walter 2007, eq. 14 and 17]. The index of
/// refraction is each vertex's own.
/// Empty: light cannot go that way at the offset, or only on the other side; the offset then carries nothing.
std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset);

/// Repeats a delta scatter at the offset. Empty: it has no such part, or all light is reflected.
std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset);

} // namespace tessera
