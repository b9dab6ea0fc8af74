#pragma once

#include "render/sampling/sampling.h"
#include "render/surface/scattering.h"

#include <optional>

namespace tessera {

/// Lambertian reflection, on the upper side only.
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
    Rgb albedo(glm::vec3) const { return reflectance; }
};

/// Diffuse V-shaped grooves with interreflection [Oren 1994], as Mitsuba's `roughdiffuse`; the upper side only.
struct RoughDiffuse {
    Rgb reflectance{0};
    float sigma = 0;   ///< standard deviation of the facets' slope angle, radians
    bool fast = false; ///< the qualitative model, without interreflection and two smaller terms

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const { return 1; }
    Rgb albedo(glm::vec3) const { return reflectance; }
};

/// The modified Phong model [Lafortune 1994]: a diffuse part and a lobe about the mirror direction, on the upper
/// side only.
struct Phong : DiffuseSpecular {
    float exponent;

    Phong(float exponent_, Rgb diffuse, Rgb specular) : DiffuseSpecular(diffuse, specular), exponent(exponent_) {}

    BsdfValue evaluate(glm::vec3 to_previous, glm::vec3 to_next) const;
    std::optional<BsdfSample> sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const;
    DeltaValue evaluate_delta(glm::vec3, Scatter) const { return {}; }
    float roughness() const;
};

} // namespace tessera
