// Lobes shared by Principled and ThinPrincipled.
#pragma once

#include "render/sampling/sampling.h"
#include "render/surface/microfacet.h"
#include "render/surface/scattering.h"
#include "render/surface/texture.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera::principled {

/// Returns (1 - cosine)^5, the weight of grazing reflectance in Schlick's approximation.
inline float schlick_weight(float cosine) {
    const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
    return (m * m) * (m * m) * m;
}

/// Returns Schlick's approximation of the Fresnel term. For eta <= 1 it uses the cosine beyond the boundary.
/// @param eta index of refraction beyond the boundary over that on this side
template <class T>
T schlick(T at_normal, float cosine, float eta) {
    if (eta <= 1)
        cosine = std::sqrt(std::max(1 - (1 - cosine * cosine) / (eta * eta), 0.0f));
    return at_normal + (T(1) - at_normal) * schlick_weight(cosine);
}

inline float reflectance_at_normal(float eta) {
    return (eta - 1) / (eta + 1) * ((eta - 1) / (eta + 1));
}

/// Returns a colour scaled to luminance 1; white for black.
inline Rgb tint(Rgb color) {
    const float l = luminance(color);
    return l > 0 ? color / l : Rgb(1);
}

/// Returns the microfacets for Disney's roughness and anisotropy [Burley 2012, 5.4].
inline Microfacets facets_of(float roughness, float anisotropic) {
    constexpr float smallest = 1e-3f;
    const float alpha = roughness * roughness;
    if (anisotropic <= 0)
        return {MicrofacetDistribution::ggx, std::max(alpha, smallest)};
    const float aspect = std::sqrt(1 - 0.9f * anisotropic);
    return Microfacets::anisotropic(MicrofacetDistribution::ggx, std::max(alpha / aspect, smallest),
                                    std::max(alpha * aspect, smallest));
}

/// Cosines of two directions on the same side.
struct Cosines {
    float previous, next; ///< to the normal
    float half;           ///< of either direction to their half vector
};

/// Returns pi f of the diffuse base over its colour.
template <class M>
float diffuse_shape(const M& m, const SurfacePoint& at, const Cosines& c) {
    const float previous = schlick_weight(c.previous), next = schlick_weight(c.next);
    // Rough surfaces are retroreflective; smooth ones darken at grazing angles [Burley 2012, 5.3].
    const float back = 2 * m.roughness.scalar(at) * c.half * c.half;
    const float shape =
        (1 - 0.5f * previous) * (1 - 0.5f * next) + back * (next + previous + next * previous * (back - 1));
    const float flatness = m.flatness.scalar(at);
    if (flatness <= 0)
        return shape;
    // Approximates subsurface scattering, after [Hanrahan 1993].
    const float below = glm::mix(1.0f, 0.5f * back, next) * glm::mix(1.0f, 0.5f * back, previous);
    const float flat = 1.25f * (below * (1 / (c.next + c.previous) - 0.5f) + 0.5f);
    return glm::mix(shape, flat, flatness);
}

/// Returns f of the sheen.
template <class M>
Rgb sheen_of(const M& m, const SurfacePoint& at, Rgb base_color, const Cosines& c) {
    const float sheen = m.sheen.scalar(at);
    if (sheen <= 0)
        return Rgb(0);
    return sheen * schlick_weight(c.half) * glm::mix(Rgb(1), tint(base_color), m.sheen_tint.scalar(at));
}

} // namespace tessera::principled
