#pragma once

#include "recon/image.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>
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

/// A sampled direction. With is_delta, f_cos is a share and pdf_w a probability, as in DeltaValue. Paths make one
/// a vertex: by std::make_optional, in its place, as a copy of what was only just written has to wait.
struct BsdfSample {
    glm::vec3 to_next;
    Rgb f_cos;
    float pdf_w; ///< > 0
    bool is_delta;
    Scatter scatter;

    BsdfSample(glm::vec3 to_next_, Rgb f_cos_, float pdf_w_, bool is_delta_, Scatter scatter_)
        : to_next(to_next_), f_cos(f_cos_), pdf_w(pdf_w_), is_delta(is_delta_), scatter(scatter_) {}
};

/// The reflectances of a diffuse part and a lobe beside it. Those that are above 1 together are scaled down to it.
struct DiffuseAndLobe {
    Rgb diffuse_reflectance{0};
    Rgb specular_reflectance{0};
    float specular_weight = 0; ///< share of samples for the lobe

    DiffuseAndLobe(Rgb diffuse, Rgb specular);

    Rgb albedo(glm::vec3) const { return diffuse_reflectance + specular_reflectance; }
};

/// Mirrors a direction on the normal of the shading frame.
inline glm::vec3 reflect(glm::vec3 d) {
    return {-d.x, -d.y, d.z};
}

/// Mirrors a direction, away from the surface, on a unit half vector.
inline glm::vec3 reflect(glm::vec3 d, glm::vec3 half) {
    return 2 * glm::dot(d, half) * half - d;
}

/// To the other side of the surface, by a mirror in it.
inline glm::vec3 across(glm::vec3 d) {
    return {d.x, d.y, -d.z};
}

/// Bends a direction, away from the surface, at a facet of unit normal `half` on either side by Snell's law. Away
/// from the surface again; nothing: total reflection.
/// @param eta index beyond the facet over that on the side of d
inline std::optional<glm::vec3> refract(glm::vec3 d, glm::vec3 half, float eta) {
    const float c = glm::dot(d, half);
    const float cos2 = 1 - (1 - c * c) / (eta * eta);
    if (cos2 <= 0)
        return {};
    return (c / eta - std::copysign(std::sqrt(cos2), c)) * half - d / eta;
}

/// The half vector, unit and on the upper side of the frame, of a reflection (eta = 1), or of a refraction.
/// @param eta index on the side of to_next over that on the side of to_previous
inline glm::vec3 half_vector(glm::vec3 to_previous, glm::vec3 to_next, float eta = 1) {
    const glm::vec3 h = glm::normalize(to_previous + eta * to_next);
    return h.z < 0 ? -h : h;
}

/// Solid angle of the half vector over that of to_next [Walter 2007, eq. 14 and 17]; eta as in half_vector().
inline float half_vector_jacobian(glm::vec3 to_previous, glm::vec3 to_next, glm::vec3 half, float eta) {
    const float sum = glm::dot(to_previous, half) + eta * glm::dot(to_next, half);
    return eta * eta * std::abs(glm::dot(to_next, half)) / (sum * sum);
}

struct DielectricFresnel {
    float reflectance; ///< share of unpolarised light that is reflected; 1 at total internal reflection
    float cos_next;    ///< signed cosine of the refracted direction, on the other side; 0 at total reflection
    float eta;         ///< index on the far side over that on the near side
};

/// @param cos_previous signed cosine on the side from which light is looked at
/// @param eta index inside (below the surface) over outside
DielectricFresnel fresnel_dielectric(float cos_previous, float eta);

/// Share of unpolarised light that a conductor of complex index eta + i k reflects, per channel.
Rgb fresnel_conductor(float cos_previous, Rgb eta, Rgb k);

} // namespace tessera
