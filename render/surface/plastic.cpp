#include "render/surface/plastic.h"

#include "render/sampling/sampling.h"
#include "render/surface/scattering.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

/// Returns the mean of a function over the facet normals visible from a direction.
template <class F>
float mean_over_facets(glm::vec3 from, const Microfacets& facets, const F& f) {
    // Uniform in t with u = (1 - cos t) / 2: denser near the edges, where the facets and the function are steep.
    constexpr int steps = 32;
    float sum = 0;
    float weights = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::vec2 t = pi / steps * (glm::vec2(i, j) + 0.5f);
            const float weight = std::sin(t.x) * std::sin(t.y);
            sum += weight * f(facets.sample_visible(from, 0.5f - 0.5f * glm::cos(t)));
            weights += weight;
        }
    return sum / weights;
}

/// Returns a unit direction with this cosine.
glm::vec3 from_cosine(float cosine) {
    return {std::sqrt(std::max(1 - cosine * cosine, 0.0f)), 0, cosine};
}

/// Returns the reflectance of a rough boundary for light from the side of `cosine` > 0: the mean of F G1.
float reflectance(float cosine, float eta, const Microfacets& facets) {
    const glm::vec3 from = from_cosine(cosine);
    return mean_over_facets(from, facets, [&](glm::vec3 normal) {
        const glm::vec3 to = reflect(from, normal);
        const float fresnel = fresnel_dielectric(glm::dot(from, normal), eta).reflectance;
        return to.z > 0 ? fresnel * facets.shadowing(to, normal) : 0.0f;
    });
}

/// Returns the transmittance of a rough boundary: the mean of (1 - F) G1 of the refracted direction. It does not
/// add up to 1 with the reflectance, because light blocked by other facets is lost, as in Mitsuba.
float transmittance_of_facets(float cosine, float eta, const Microfacets& facets) {
    const glm::vec3 from = from_cosine(cosine);
    return mean_over_facets(from, facets, [&](glm::vec3 normal) {
        const float along = glm::dot(from, normal);
        const DielectricFresnel fresnel = fresnel_dielectric(along, eta);
        if (fresnel.reflectance >= 1)
            return 0.0f;
        const glm::vec3 to = normal * (along / fresnel.eta + fresnel.cos_next) - from / fresnel.eta;
        return to.z < 0 ? (1 - fresnel.reflectance) * facets.shadowing(to, normal) : 0.0f;
    });
}

/// Returns the reflectance of a boundary for diffuse light, whose density over cosines is 2 cos.
float diffuse_reflectance_of(float eta, const Microfacets& facets) {
    float sum = 0;
    if (facets.alpha <= 0) {
        constexpr int steps = 256; // midpoint rule; total internal reflection has a sharp edge
        for (int i = 0; i < steps; ++i) {
            const float cosine = (static_cast<float>(i) + 0.5f) / steps;
            sum += 2 * cosine * fresnel_dielectric(cosine, eta).reflectance / steps;
        }
        return sum;
    }
    // Mitsuba's `roughplastic` averages 64 values including both ends instead of integrating; this matches it.
    constexpr int values = 64;
    for (int i = 0; i < values; ++i) {
        const float cosine = std::max(static_cast<float>(i) / (values - 1), 1e-6f);
        sum += 2 * cosine * reflectance(cosine, eta, facets) / values;
    }
    return sum;
}

float mean(Rgb c) {
    return (c.r + c.g + c.b) / 3;
}

} // namespace

Coating::Coating(float eta_, MicrofacetDistribution distribution, float alpha) : eta(eta_) {
    const Microfacets facets{distribution, alpha > 0 ? std::max(alpha, smallest_alpha) : 0};
    for (int i = 0; i < resolution; ++i) {
        const float cosine = std::max(static_cast<float>(i) / (resolution - 1), 1e-4f);
        table[i] = facets.alpha > 0 ? transmittance_of_facets(cosine, eta, facets)
                                    : 1 - fresnel_dielectric(cosine, eta).reflectance;
    }
    internal_reflectance = diffuse_reflectance_of(1 / eta, facets);
}

Coating Coating::without_bounces(float eta) {
    Coating coating(eta, MicrofacetDistribution::beckmann, 0);
    coating.internal_reflectance = 1 - 1 / (eta * eta); // cancels the factor 1 / eta^2 in Plastic::base
    return coating;
}

float Coating::transmittance(float cosine) const {
    const float scaled = std::clamp(cosine, 0.0f, 1.0f) * (resolution - 1);
    const int i = std::min(static_cast<int>(scaled), resolution - 2);
    const float t = scaled - static_cast<float>(i);
    return (1 - t) * table[i] + t * table[i + 1];
}

Plastic::Plastic(const Coating& coating_, Microfacets facets_, Rgb specular, Rgb diffuse, bool nonlinear)
    : coating(&coating_), facets(facets_), specular_reflectance(specular) {
    // Geometric series of bounces between base and coating; 1 / eta^2 accounts for the solid angle on leaving.
    const Rgb back = (nonlinear ? glm::min(diffuse, Rgb(1)) : Rgb(1)) * coating->internal_reflectance;
    base = diffuse / (Rgb(1) - back) / (coating->eta * coating->eta);
    const float s = mean(specular), d = mean(diffuse);
    specular_weight = s + d > 0 ? s / (s + d) : 0;
}

float Plastic::specular_probability(float cosine) const {
    const float in = coating->transmittance(cosine);
    const float specular = (1 - in) * specular_weight, diffuse = in * (1 - specular_weight);
    return specular + diffuse > 0 ? specular / (specular + diffuse) : 1;
}

BsdfValue Plastic::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    const float specular_share = specular_probability(to_previous.z);
    const float cosine_pdf = to_next.z * inv_pi;
    BsdfValue v;
    v.pdf_w = (1 - specular_share) * cosine_pdf;
    v.f_cos = base * (cosine_pdf * coating->transmittance(to_previous.z) * coating->transmittance(to_next.z));
    if (is_smooth())
        return v;
    const glm::vec3 half = half_vector(to_previous, to_next);
    const float facet_pdf = facets.density(half) * facets.shadowing(to_previous, half) / (4 * to_previous.z);
    const float fresnel = fresnel_dielectric(glm::dot(to_previous, half), coating->eta).reflectance;
    v.pdf_w += specular_share * facet_pdf;
    v.f_cos += specular_reflectance * (fresnel * facet_pdf * facets.shadowing(to_next, half));
    return v;
}

Rgb Plastic::albedo(glm::vec3 to_previous) const {
    const float in = coating->transmittance(to_previous.z);
    // Diffuse light leaves with the fraction 1 - internal_reflectance; eta^2 cancels the factor in `base`.
    const float out = (1 - coating->internal_reflectance) * coating->eta * coating->eta;
    return (1 - in) * specular_reflectance + in * out * base;
}

DeltaValue Plastic::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    if (!is_smooth() || to_previous.z <= 0 || scatter != Scatter::reflect)
        return {};
    const float fresnel = fresnel_dielectric(to_previous.z, coating->eta).reflectance;
    return {reflect(to_previous), specular_reflectance * fresnel, specular_probability(to_previous.z)};
}

std::optional<BsdfSample> Plastic::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    if (to_previous.z <= 0)
        return {};
    const bool specular = lobe < specular_probability(to_previous.z);
    if (specular && is_smooth()) {
        const DeltaValue v = evaluate_delta(to_previous, Scatter::reflect);
        if (is_black(v.value))
            return {};
        return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, Scatter::reflect);
    }
    const glm::vec3 to_next =
        specular ? reflect(to_previous, facets.sample_visible(to_previous, u)) : sample_cosine_hemisphere(u);
    const BsdfValue v = evaluate(to_previous, to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
}

} // namespace tessera
