#include "render/bsdf/phong.h"

#include "render/sampling.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

float largest(Rgb c) {
    return std::max({c.r, c.g, c.b});
}

/// A direction about +z with density (n + 1) / (2 pi) cos^n.
glm::vec3 sample_lobe(float exponent, glm::vec2 u) {
    // By logarithms, as a float next to 1 has no digits for what a sharp lobe is made of.
    const float log_z = std::log1p(-u.x) / (exponent + 1);
    const float z = std::exp(log_z);
    const float r = std::sqrt(-std::expm1(2 * log_z));
    const float phi = 2 * pi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

} // namespace

Phong::Phong(float exponent_, Rgb diffuse, Rgb specular) : exponent(exponent_) {
    const float scale = 1 / std::max(largest(diffuse + specular), 1.0f);
    diffuse_reflectance = diffuse * scale;
    specular_reflectance = specular * scale;
    const float s = specular.r + specular.g + specular.b, d = diffuse.r + diffuse.g + diffuse.b;
    specular_weight = s + d > 0 ? s / (s + d) : 0;
}

BsdfValue Phong::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    // [Lafortune 1994, eq. 8 and 10]
    // The cosine by the chord: exact for sharp lobes, too.
    const glm::vec3 chord = to_next - reflect(to_previous);
    const float less_than_one = 0.5f * glm::dot(chord, chord); // 1 - cos
    const float lobe = less_than_one < 1 ? std::exp(exponent * std::log1p(-less_than_one)) * 0.5f * inv_pi : 0;
    const float cosine_pdf = to_next.z * inv_pi;
    return {diffuse_reflectance * cosine_pdf + specular_reflectance * ((exponent + 2) * lobe * to_next.z),
            (1 - specular_weight) * cosine_pdf + specular_weight * (exponent + 1) * lobe};
}

std::optional<BsdfSample> Phong::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    if (to_previous.z <= 0)
        return {};
    const glm::vec3 to_next = lobe < specular_weight
                                  ? Frame(reflect(to_previous)).to_world(sample_lobe(exponent, u))
                                  : sample_cosine_hemisphere(u);
    const BsdfValue v = evaluate(to_previous, to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
}

float Phong::roughness() const {
    // Of the microfacets whose normals have this exponent [Walter 2007, 5.2]; the lobe itself is narrower.
    return is_black(diffuse_reflectance) ? std::min(std::sqrt(2 / (exponent + 2)), 1.0f) : 1;
}

} // namespace tessera
