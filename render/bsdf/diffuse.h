#pragma once

#include "render/bsdf/scattering.h"
#include "render/sampling.h"

#include <optional>

namespace tessera {

/// Lambert's law, on the upper side only.
struct Diffuse {
    Rgb reflectance{0};

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
        if (to_previous.z <= 0 || to_next.z <= 0)
            return {};
        const float pdf_w = to_next.z * inv_pi;
        return {reflectance * pdf_w, pdf_w};
    }

    std::optional<BsdfSample> sample(glm::vec3 to_previous, float, glm::vec2 u) const {
        const glm::vec3 to_next = sample_cosine_hemisphere(u);
        const BsdfValue v = evaluate(to_previous, to_next);
        if (v.pdf_w <= 0 || is_black(v.f_cos))
            return {};
        return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
    }

    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return 1; }
};

} // namespace tessera
