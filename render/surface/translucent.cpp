#include "render/surface/translucent.h"

#include "render/sampling/sampling.h"

#include <algorithm>
#include <cmath>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace tessera {

BsdfValue DiffuseTransmitter::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z * to_next.z >= 0)
        return {};
    const float pdf_w = std::abs(to_next.z) * inv_pi;
    return {transmittance * pdf_w, pdf_w};
}

std::optional<BsdfSample> DiffuseTransmitter::sample(glm::vec3 to_previous, float, glm::vec2 u) const {
    glm::vec3 to_next = sample_cosine_hemisphere(u);
    if (to_previous.z > 0)
        to_next = -to_next;
    const BsdfValue v = evaluate(to_previous, to_next);
    if (v.pdf_w <= 0 || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::transmit);
}

namespace {

/// Returns the phase function for the cosine of the scattering angle, per solid angle [Henyey 1941].
float phase(float cosine, float g) {
    const float d = std::max(1 + g * g - 2 * g * cosine, 1e-8f);
    return 0.25f * inv_pi * (1 - g * g) / (d * std::sqrt(d));
}

/// Samples the cosine of the scattering angle in proportion to the phase function.
float sample_phase(float u, float g) {
    if (std::abs(g) < 1e-3f)
        return 1 - 2 * u;
    const float s = (1 - g * g) / (1 - g + 2 * g * u);
    return std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
}

} // namespace

Rgb MediumLayer::unscattered(float cosine) const {
    return glm::exp(-depth / std::max(std::abs(cosine), 1e-6f));
}

BsdfValue MediumLayer::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z == 0 || to_next.z == 0 || is_black(scattered * depth))
        return {};
    // Integrates, over the depth z of the scattering event, the transmittances of the ways to z and from z.
    const float in = 1 / std::abs(to_next.z), out = 1 / std::abs(to_previous.z);
    const bool transmits = to_previous.z * to_next.z < 0;
    const float rate = transmits ? std::abs(in - out) : in + out;
    const Rgb attenuation = transmits ? glm::exp(-depth * std::min(in, out)) : Rgb(1);
    const Rgb integral = rate < 1e-3f ? depth : (1.0f - glm::exp(-rate * depth)) / rate;
    const float p = phase(-glm::dot(to_previous, to_next), g);
    const float delta_probability = evaluate_delta(to_previous, Scatter::transmit).probability;
    return {scattered * attenuation * integral * (p * out), (1 - delta_probability) * p};
}

DeltaValue MediumLayer::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    if (scatter != Scatter::transmit || to_previous.z == 0 || !is_clear)
        return {};
    const Rgb fraction = unscattered(to_previous.z);
    return {-to_previous, fraction, (fraction.r + fraction.g + fraction.b) / 3};
}

std::optional<BsdfSample> MediumLayer::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    const DeltaValue straight = evaluate_delta(to_previous, Scatter::transmit);
    if (lobe < straight.probability)
        return std::make_optional<BsdfSample>(straight.to_next, straight.value, straight.probability, true,
                                              Scatter::transmit);
    const float cosine = sample_phase(u.x, g), sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
    const float phi = 2 * pi * u.y;
    const glm::vec3 to_next =
        glm::normalize(Frame(-to_previous).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine}));
    const BsdfValue v = evaluate(to_previous, to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false,
                                          to_previous.z * to_next.z > 0 ? Scatter::reflect : Scatter::transmit);
}

float MediumLayer::roughness() const {
    return is_black(scattered * depth) ? 0 : 1 - std::abs(g);
}

} // namespace tessera
