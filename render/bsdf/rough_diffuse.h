#pragma once

#include "render/bsdf/scattering.h"

#include <optional>

namespace tessera {

/// Diffuse V-shaped grooves with the light that goes from one wall to the other [Oren 1994], as Mitsuba's
/// `roughdiffuse`; the upper side only.
struct RoughDiffuse {
    Rgb reflectance{0};
    float sigma = 0;   ///< standard deviation of the slope's angle
    bool fast = false; ///< without interreflection and two of the smaller terms

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return 1; }
};

} // namespace tessera
