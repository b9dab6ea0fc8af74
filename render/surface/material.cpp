#include "render/surface/material.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Returns the filtered value of a reflectance or transmittance. Values above 1, from float files or scaled
/// textures, are kept and create energy, as in Mitsuba 3.
Rgb factor(const Texture& texture, const SurfacePoint& at) {
    return glm::max(texture.filtered(at), 0.0f);
}

Bsdf resolve(const DiffuseMaterial& m, const SurfacePoint& at) {
    const float alpha = m.alpha.scalar(at);
    if (alpha <= 0)
        return {Diffuse{factor(m.reflectance, at)}};
    // Mitsuba's conversion of the RMS slope to the standard deviation of the slope angle.
    return {RoughDiffuse{factor(m.reflectance, at), alpha / std::sqrt(2.0f), m.fast}};
}

/// Returns the microfacets of a ConductorMaterial or DielectricMaterial; alpha = 0: smooth.
template <class M>
Microfacets facets_of(const M& m, const SurfacePoint& at) {
    const float alpha = m.alpha.scalar(at);
    if (m.alpha_v) {
        const float along_v = m.alpha_v->scalar(at);
        if (std::max(alpha, along_v) > 0)
            return Microfacets::anisotropic(m.distribution, alpha, along_v);
    }
    return {m.distribution, alpha > 0 ? std::max(alpha, smallest_alpha) : 0};
}

Bsdf resolve(const ConductorMaterial& m, const SurfacePoint& at) {
    const Microfacets facets = facets_of(m, at);
    const Rgb specular_reflectance = factor(m.specular_reflectance, at);
    if (facets.alpha <= 0)
        return {SmoothConductor{m.eta, m.k, specular_reflectance}};
    return {RoughConductor{facets, m.eta, m.k, specular_reflectance}};
}

Bsdf resolve(const DielectricMaterial& m, const SurfacePoint& at) {
    const Rgb reflectance = factor(m.specular_reflectance, at),
              transmittance = factor(m.specular_transmittance, at);
    if (m.thin)
        return {ThinDielectric{m.eta, reflectance, transmittance}};
    const Microfacets facets = facets_of(m, at);
    if (facets.alpha > 0 && std::abs(m.eta - 1) > 1e-3f) // without refraction, roughness is invisible
        return {RoughDielectric{facets, m.eta, reflectance, transmittance}};
    return {SmoothDielectric{m.eta, reflectance, transmittance}};
}

Bsdf resolve(const PlasticMaterial& m, const SurfacePoint& at) {
    return {Plastic(*m.coating, m.facets, factor(m.specular_reflectance, at), factor(m.diffuse_reflectance, at),
                    m.nonlinear)};
}

Bsdf resolve(const PhongMaterial& m, const SurfacePoint& at) {
    return {Phong(std::max(m.exponent.scalar(at), 0.0f), factor(m.diffuse_reflectance, at),
                  factor(m.specular_reflectance, at))};
}

Bsdf resolve(const MixtureMaterial& m, const SurfacePoint& at) {
    return {UncommonBsdf{Mixture{&m, at}}};
}

Bsdf resolve(const CoatedMaterial& m, const SurfacePoint& at) {
    return {UncommonBsdf{Coated{&m, at}}};
}

Bsdf resolve(const PrincipledMaterial& m, const SurfacePoint& at) {
    return {UncommonBsdf{Principled{&m, at}}};
}

Bsdf resolve(const ThinPrincipledMaterial& m, const SurfacePoint& at) {
    return {UncommonBsdf{ThinPrincipled{&m, at}}};
}

Bsdf resolve(const WardMaterial& m, const SurfacePoint& at) {
    const glm::vec2 alpha(m.alpha.scalar(at), m.alpha_v ? m.alpha_v->scalar(at) : m.alpha.scalar(at));
    return {UncommonBsdf{Ward(m.variant, glm::max(alpha, smallest_alpha), factor(m.diffuse_reflectance, at),
                              factor(m.specular_reflectance, at))}};
}

Bsdf resolve(const DiffuseTransmitterMaterial& m, const SurfacePoint& at) {
    return {UncommonBsdf{DiffuseTransmitter{factor(m.transmittance, at)}}};
}

Bsdf resolve(const MediumLayerMaterial& m, const SurfacePoint& at) {
    Rgb sigma_s = glm::max(m.scattered.evaluate(at), 0.0f), sigma_t = glm::max(m.lost.evaluate(at), 0.0f);
    if (m.by_share)
        sigma_s = glm::min(sigma_s, 1.0f) * sigma_t;
    else
        sigma_t += sigma_s;
    const Rgb albedo = sigma_s / glm::max(sigma_t, 1e-20f);
    return {UncommonBsdf{MediumLayer{albedo, sigma_t * m.thickness, m.g, m.is_clear}}};
}

std::vector<const Texture*> textures(const DiffuseMaterial& m) {
    return {&m.reflectance, &m.alpha};
}
std::vector<const Texture*> textures(const ConductorMaterial& m) {
    return {&m.alpha, m.alpha_v ? &*m.alpha_v : &m.alpha, &m.specular_reflectance};
}
std::vector<const Texture*> textures(const DielectricMaterial& m) {
    return {&m.specular_reflectance, &m.specular_transmittance, &m.alpha, m.alpha_v ? &*m.alpha_v : &m.alpha};
}
std::vector<const Texture*> textures(const PlasticMaterial& m) {
    return {&m.diffuse_reflectance, &m.specular_reflectance};
}
std::vector<const Texture*> textures(const PhongMaterial& m) {
    return {&m.exponent, &m.diffuse_reflectance, &m.specular_reflectance};
}
std::vector<const Texture*> textures(const MixtureMaterial& m) {
    std::vector<const Texture*> all;
    if (m.blend_weight)
        all.push_back(&*m.blend_weight);
    for (const std::shared_ptr<const Material>& part : m.parts)
        for (const Texture* t : part->textures())
            all.push_back(t);
    return all;
}
std::vector<const Texture*> textures(const CoatedMaterial& m) {
    std::vector<const Texture*> all = m.base->textures();
    all.push_back(&m.sigma_a);
    all.push_back(&m.specular_reflectance);
    return all;
}

std::vector<const Texture*> textures(const PrincipledMaterial& m) {
    return {&m.base_color, &m.roughness,  &m.anisotropic, &m.metallic,  &m.spec_trans,     &m.spec_tint,
            &m.sheen,      &m.sheen_tint, &m.flatness,    &m.clearcoat, &m.clearcoat_gloss};
}
std::vector<const Texture*> textures(const ThinPrincipledMaterial& m) {
    return {&m.base_color, &m.roughness, &m.anisotropic, &m.spec_trans, &m.eta,
            &m.spec_tint,  &m.sheen,     &m.sheen_tint,  &m.flatness,   &m.diff_trans};
}

std::vector<const Texture*> textures(const WardMaterial& m) {
    return {&m.alpha, m.alpha_v ? &*m.alpha_v : &m.alpha, &m.diffuse_reflectance, &m.specular_reflectance};
}
std::vector<const Texture*> textures(const DiffuseTransmitterMaterial& m) {
    return {&m.transmittance};
}
std::vector<const Texture*> textures(const MediumLayerMaterial& m) {
    return {&m.scattered, &m.lost};
}

bool is_anisotropic(const WardMaterial& m) {
    return m.alpha_v.has_value();
}
bool is_anisotropic(const ConductorMaterial& m) {
    return m.alpha_v.has_value();
}
bool is_anisotropic(const DielectricMaterial& m) {
    return m.alpha_v.has_value() && !m.thin;
}
bool is_anisotropic(const MixtureMaterial& m) {
    return std::any_of(m.parts.begin(), m.parts.end(), [](const auto& part) { return part->is_anisotropic(); });
}
bool is_anisotropic(const CoatedMaterial& m) {
    return m.base->is_anisotropic();
}
template <class M>
bool is_anisotropic(const M&) {
    return false;
}

bool is_anisotropic(const PrincipledMaterial& m) {
    return !m.anisotropic.is_black();
}
bool is_anisotropic(const ThinPrincipledMaterial& m) {
    return !m.anisotropic.is_black();
}

} // namespace

float MixtureMaterial::weight(std::size_t part, const SurfacePoint& at) const {
    if (!blend_weight)
        return weights[part];
    const float second = std::clamp(luminance(blend_weight->evaluate(at)), 0.0f, 1.0f);
    return part == 1 ? second : 1 - second;
}

std::vector<const Texture*> Material::textures() const {
    std::vector<const Texture*> all = std::visit([](const auto& m) { return tessera::textures(m); }, kind);
    if (opacity)
        all.push_back(&*opacity);
    if (relief)
        all.push_back(&relief->map);
    if (back)
        for (const Texture* texture : back->textures())
            all.push_back(texture);
    return all;
}

bool Material::is_textured() const {
    const std::vector<const Texture*> all = textures();
    return std::any_of(all.begin(), all.end(), [](const Texture* t) { return !t->is_constant(); });
}

bool Material::is_mask() const {
    return opacity && !(opacity->is_constant() && std::get<Rgb>(opacity->kind) == Rgb(1));
}

bool Material::is_anisotropic() const {
    return std::visit([](const auto& m) { return tessera::is_anisotropic(m); }, kind) ||
           (back && back->is_anisotropic());
}

bool Material::is_transparent() const {
    if (const auto* mixture = std::get_if<MixtureMaterial>(&kind))
        return std::any_of(mixture->parts.begin(), mixture->parts.end(),
                           [](const auto& part) { return part->is_transparent(); });
    if (const auto* principled = std::get_if<PrincipledMaterial>(&kind))
        return !principled->spec_trans.is_black();
    return std::holds_alternative<DielectricMaterial>(kind) ||
           std::holds_alternative<ThinPrincipledMaterial>(kind) ||
           std::holds_alternative<DiffuseTransmitterMaterial>(kind) ||
           std::holds_alternative<MediumLayerMaterial>(kind);
}

Bsdf Material::resolve(const SurfacePoint& at) const {
    return std::visit([&](const auto& m) { return tessera::resolve(m, at); }, kind);
}

} // namespace tessera
