#pragma once

#include "recon/image.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

enum class Scatter : std::uint8_t { reflect, transmit };

/// The non-delta part of a BSDF for two directions. Both members are 0 if no light is scattered between them.
struct BsdfValue {
    Rgb f_cos{0};    ///< f times |cos| of to_next, per solid angle
    float pdf_w = 0; ///< pdf of sampling to_next given to_previous, per solid angle
};

/// The delta part of a BSDF for one kind of scattering (reflect or transmit).
struct DeltaValue {
    glm::vec3 to_next{0};  ///< the only direction
    Rgb value{0};          ///< the factor on radiance
    float probability = 0; ///< probability of sampling it; 0: no delta part
};

/// A sampled direction. With is_delta, f_cos and pdf_w hold DeltaValue::value and probability. The constructor
/// allows std::make_optional to build it in place, because copying a value that was just written stalls the CPU.
struct BsdfSample {
    glm::vec3 to_next;
    Rgb f_cos;
    float pdf_w; ///< > 0, per solid angle
    bool is_delta;
    Scatter scatter;

    BsdfSample(glm::vec3 to_next_, Rgb f_cos_, float pdf_w_, bool is_delta_, Scatter scatter_)
        : to_next(to_next_), f_cos(f_cos_), pdf_w(pdf_w_), is_delta(is_delta_), scatter(scatter_) {}
};

/// Reflectances of a diffuse part and a glossy lobe, scaled down where their sum exceeds 1.
struct DiffuseSpecular {
    Rgb diffuse_reflectance{0};
    Rgb specular_reflectance{0};
    float specular_weight = 0; ///< probability of sampling the lobe

    DiffuseSpecular(Rgb diffuse, Rgb specular);

    Rgb albedo(glm::vec3) const { return diffuse_reflectance + specular_reflectance; }
};

/// Reflects a direction about the shading normal.
inline glm::vec3 reflect(glm::vec3 d) {
    return {-d.x, -d.y, d.z};
}

/// Reflects a direction (away from the surface) about a unit half vector.
inline glm::vec3 reflect(glm::vec3 d, glm::vec3 half) {
    return 2 * glm::dot(d, half) * half - d;
}

/// Mirrors a direction in the surface, to its other side.
inline glm::vec3 across(glm::vec3 d) {
    return {d.x, d.y, -d.z};
}

/// Refracts a direction at a facet with unit normal `half` (on either side) by Snell's law. Both directions point
/// away from the surface. Returns an empty value at total internal reflection.
/// @param eta index of refraction beyond the facet over that on the side of d
inline std::optional<glm::vec3> refract(glm::vec3 d, glm::vec3 half, float eta) {
    const float c = glm::dot(d, half);
    const float cos2 = 1 - (1 - c * c) / (eta * eta);
    if (cos2 <= 0)
        return {};
    return (c / eta - std::copysign(std::sqrt(cos2), c)) * half - d / eta;
}

/// Returns the half vector of a reflection (eta = 1) or a refraction; unit, on the upper side of the frame.
/// @param eta index of refraction on the side of to_next over that on the side of to_previous
inline glm::vec3 half_vector(glm::vec3 to_previous, glm::vec3 to_next, float eta = 1) {
    const glm::vec3 h = glm::normalize(to_previous + eta * to_next);
    return h.z < 0 ? -h : h;
}

/// Returns d_h / d_w of theory (15) [Walter 2007, eq. 14 and 17], where w is to_next; eta as in half_vector().
inline float half_vector_jacobian(glm::vec3 to_previous, glm::vec3 to_next, glm::vec3 half, float eta) {
    const float sum = glm::dot(to_previous, half) + eta * glm::dot(to_next, half);
    return eta * eta * std::abs(glm::dot(to_next, half)) / (sum * sum);
}

struct DielectricFresnel {
    float reflectance; ///< for unpolarised light; 1 at total internal reflection
    float cos_next;    ///< signed cosine of the refracted direction; 0 at total internal reflection
    float eta;         ///< index of refraction on the far side over that on the near side
};

/// Evaluates the Fresnel equations of a dielectric boundary.
/// @param cos_previous signed cosine of to_previous to the normal or facet; positive outside
/// @param eta index of refraction inside (below the surface) over outside
DielectricFresnel fresnel_dielectric(float cos_previous, float eta);

/// Returns the reflectance of a conductor with complex index eta + i k for unpolarised light.
Rgb fresnel_conductor(float cos_previous, Rgb eta, Rgb k);

} // namespace tessera
