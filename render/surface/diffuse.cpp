#include "render/surface/diffuse.h"

#include "render/sampling/sampling.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// The angles of the Oren-Nayar model.
struct Angles {
    float alpha, beta; ///< larger and smaller angle to the normal
    float sin_alpha, tan_beta;
    float tan_mean; ///< tangent of the mean of alpha and beta
    float cos_phi;  ///< cosine of the azimuth between the two directions
};

Angles angles_of(glm::vec3 a, glm::vec3 b) {
    if (a.z > b.z)
        std::swap(a, b);
    const float sin_a = std::hypot(a.x, a.y), sin_b = std::hypot(b.x, b.y);
    const float product = sin_a * sin_b;
    const float cos_phi = product > 1e-8f ? std::clamp((a.x * b.x + a.y * b.y) / product, -1.0f, 1.0f) : 0;
    return {std::atan2(sin_a, a.z),
            std::atan2(sin_b, b.z),
            sin_a,
            sin_b / b.z,
            (sin_a + sin_b) / (a.z + b.z),
            cos_phi};
}

/// Returns pi f over the reflectance in the qualitative model [Oren 1994].
float qualitative(const Angles& a, float sigma2) {
    const float constant = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
    const float facing = 0.45f * sigma2 / (sigma2 + 0.09f);
    return constant + facing * std::max(a.cos_phi, 0.0f) * a.sin_alpha * a.tan_beta;
}

/// Returns pi f in the full model, with single and double scattering [Oren 1994].
Rgb full(const Angles& a, float sigma2, Rgb reflectance) {
    const float steep = sigma2 / (sigma2 + 0.09f);
    const float beta = 2 * inv_pi * a.beta;
    const float both = 4 * inv_pi * inv_pi * a.alpha * a.beta;
    const float c1 = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
    const float c2 = 0.45f * steep * (a.cos_phi > 0 ? a.sin_alpha : a.sin_alpha - beta * beta * beta);
    const float c3 = 0.125f * steep * both * both;
    const float once = c1 + a.cos_phi * c2 * a.tan_beta + (1 - std::abs(a.cos_phi)) * c3 * a.tan_mean;
    const float twice = 0.17f * sigma2 / (sigma2 + 0.13f) * (1 - a.cos_phi * beta * beta);
    // The fit is negative for dark, very rough surfaces at grazing angles.
    return glm::max(reflectance * once + reflectance * reflectance * twice, 0.0f);
}

} // namespace

BsdfValue RoughDiffuse::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    const Angles angles = angles_of(to_previous, to_next);
    const float pdf_w = to_next.z * inv_pi;
    const float sigma2 = sigma * sigma;
    const Rgb pi_f = fast ? reflectance * qualitative(angles, sigma2) : full(angles, sigma2, reflectance);
    return {pi_f * pdf_w, pdf_w};
}

std::optional<BsdfSample> RoughDiffuse::sample(glm::vec3 to_previous, float, glm::vec2 u) const {
    const glm::vec3 to_next = sample_cosine_hemisphere(u);
    const BsdfValue v = evaluate(to_previous, to_next);
    if (v.pdf_w <= 0 || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
}

namespace {

/// Samples a direction about +z with pdf_w = (n + 1) / (2 pi) cos^n.
glm::vec3 sample_lobe(float exponent, glm::vec2 u) {
    // Logarithms keep precision for sharp lobes, where the cosine is close to 1.
    const float log_z = std::log1p(-u.x) / (exponent + 1);
    const float z = std::exp(log_z);
    const float r = std::sqrt(-std::expm1(2 * log_z));
    const float phi = 2 * pi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

} // namespace

BsdfValue Phong::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    // [Lafortune 1994, eq. 8 and 10]. 1 - cos is found from the chord, which is accurate for sharp lobes.
    const glm::vec3 chord = to_next - reflect(to_previous);
    const float one_minus_cos = 0.5f * glm::dot(chord, chord);
    const float lobe = one_minus_cos < 1 ? std::exp(exponent * std::log1p(-one_minus_cos)) * 0.5f * inv_pi : 0;
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
    // The alpha of microfacets with this exponent [Walter 2007, 5.2]; it overestimates the width of the lobe.
    return is_black(diffuse_reflectance) ? std::min(std::sqrt(2 / (exponent + 2)), 1.0f) : 1;
}

} // namespace tessera
