#include "render/surface/scattering.h"

#include "render/surface/bsdf.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec2.hpp>

namespace tessera {

DiffuseSpecular::DiffuseSpecular(Rgb diffuse, Rgb specular) {
    const Rgb both = diffuse + specular;
    const float scale = 1 / std::max({both.r, both.g, both.b, 1.0f});
    diffuse_reflectance = diffuse * scale;
    specular_reflectance = specular * scale;
    const float s = specular.r + specular.g + specular.b, d = diffuse.r + diffuse.g + diffuse.b;
    specular_weight = s + d > 0 ? s / (s + d) : 0;
}

DielectricFresnel fresnel_dielectric(float cos_previous, float eta) {
    const bool outside = cos_previous >= 0;
    const float far_over_near = outside ? eta : 1 / eta;
    const float near_over_far = outside ? 1 / eta : eta;
    const float c = std::abs(cos_previous);
    const float cos2 = 1 - (1 - c * c) * near_over_far * near_over_far; // Snell's law
    if (cos2 <= 0)
        return {1, 0, far_over_near};
    const float t = std::sqrt(cos2);
    const float parallel = (far_over_near * c - t) / (far_over_near * c + t);
    const float perpendicular = (c - far_over_near * t) / (c + far_over_near * t);
    const float reflectance =
        far_over_near == 1 ? 0 : 0.5f * (parallel * parallel + perpendicular * perpendicular);
    return {reflectance, outside ? -t : t, far_over_near};
}

Rgb fresnel_conductor(float cos_previous, Rgb eta, Rgb k) {
    // The exact equations in terms of a^2 + b^2 and a [Born and Wolf, 14.2].
    const float cos2 = cos_previous * cos_previous;
    const float sin2 = 1 - cos2;
    const Rgb n = eta * eta - k * k - sin2;
    const Rgb a2_plus_b2 = glm::sqrt(glm::max(n * n + 4.0f * eta * eta * k * k, 0.0f));
    const Rgb a = glm::sqrt(glm::max(0.5f * (a2_plus_b2 + n), 0.0f));

    const Rgb s1 = a2_plus_b2 + cos2;
    const Rgb s2 = 2.0f * cos_previous * a;
    const Rgb p1 = a2_plus_b2 * cos2 + sin2 * sin2;
    const Rgb p2 = s2 * sin2;
    // Mean of two reflectances: perpendicular, s = (s1 - s2) / (s1 + s2), and parallel, s (p1 - p2) / (p1 + p2).
    return (s1 - s2) * p1 / ((s1 + s2) * (p1 + p2));
}

namespace {

constexpr std::string_view kind_names[] = {"diffuse",    "roughdiffuse",    "roughconductor", "conductor",
                                           "dielectric", "roughdielectric", "thindielectric", "plastic",
                                           "phong"}; // alternatives of Bsdf::kind except the last
static_assert(std::size(kind_names) + 1 == std::variant_size_v<decltype(Bsdf::kind)>);

constexpr std::string_view further_names[] = {"mixture", "coating",   "principled", "principledthin",
                                              "ward",    "difftrans", "hk"};
static_assert(std::size(further_names) == std::variant_size_v<decltype(UncommonBsdf::kind)>);

} // namespace

std::string_view kind_name(const Bsdf& bsdf) {
    const auto* further = std::get_if<UncommonBsdf>(&bsdf.kind);
    return further ? further_names[further->kind.index()] : kind_names[bsdf.kind.index()];
}

float Bsdf::shadowing(glm::vec3 to_next) const {
    const float cosine = glm::dot(interpolated_normal, to_next);
    const float tan2 = std::max(1 / (cosine * cosine) - 1, 0.0f);
    return 2 / (1 + std::sqrt(1 + terminator * tan2)); // [Estevez 2019, 12.3]
}

BsdfValue Bsdf::evaluate_bent(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (is_turned(to_previous)) {
        to_previous = half_turn(to_previous);
        to_next = half_turn(to_next);
    }
    if (is_cut(to_previous, to_next))
        return {};
    const BsdfValue v = std::visit([&](const auto& b) { return b.evaluate(to_previous, to_next); }, kind);
    return {v.f_cos * shadowing(to_next), v.pdf_w};
}

std::optional<BsdfSample> Bsdf::sample_bent(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    const bool turned = is_turned(to_previous);
    if (turned)
        to_previous = half_turn(to_previous);
    auto s = std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    if (!s || is_cut(to_previous, s->to_next))
        return {};
    s->f_cos *= shadowing(s->to_next);
    if (turned)
        s->to_next = half_turn(s->to_next);
    return s;
}

DeltaValue Bsdf::evaluate_delta_bent(glm::vec3 to_previous, Scatter scatter) const {
    const bool turned = is_turned(to_previous);
    if (turned)
        to_previous = half_turn(to_previous);
    const DeltaValue v = std::visit([&](const auto& b) { return b.evaluate_delta(to_previous, scatter); }, kind);
    if (is_cut(to_previous, v.to_next))
        return {};
    return {turned ? half_turn(v.to_next) : v.to_next, v.value * shadowing(v.to_next), v.probability};
}

} // namespace tessera
