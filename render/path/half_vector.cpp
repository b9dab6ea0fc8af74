#include "render/path/half_vector.h"

namespace tessera {

std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset) {
    const glm::vec3 half = half_vector(base.to_previous, base_to_next);
    const glm::vec3 to_next = reflect(offset.to_previous, half);
    const float cos_base = std::abs(glm::dot(base_to_next, half));
    const float cos_offset = std::abs(glm::dot(to_next, half));
    const BsdfValue v = offset.bsdf.evaluate(offset.to_previous, to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos) || !(cos_base > 0))
        return {};
    return CopiedScatter{to_next, v.f_cos, v.pdf_w, cos_offset / cos_base};
}

std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset) {
    const DeltaValue v = offset.bsdf.evaluate_delta(offset.to_previous, scatter);
    if (!(v.probability > 0) || is_black(v.value))
        return {};
    return CopiedScatter{v.to_next, v.value, v.probability, 1};
}

} // namespace tessera
