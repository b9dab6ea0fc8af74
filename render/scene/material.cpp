#include "render/scene/material.h"

#include <algorithm>

namespace tessera {

namespace {

Bsdf resolve(const DiffuseMaterial& m, glm::vec2 uv) {
    return {Diffuse{m.reflectance.evaluate(uv)}};
}

Bsdf resolve(const ConductorMaterial& m, glm::vec2 uv) {
    const float alpha = m.alpha.evaluate(uv).r;
    const Rgb specular_reflectance = m.specular_reflectance.evaluate(uv);
    if (alpha <= 0)
        return {SmoothConductor{m.eta, m.k, specular_reflectance}};
    return {RoughConductor{{m.distribution, std::max(alpha, smallest_alpha)}, m.eta, m.k, specular_reflectance}};
}

Bsdf resolve(const DielectricMaterial& m, glm::vec2 uv) {
    const Rgb reflectance = m.specular_reflectance.evaluate(uv),
              transmittance = m.specular_transmittance.evaluate(uv);
    if (m.thin)
        return {ThinDielectric{m.eta, reflectance, transmittance}};
    return {SmoothDielectric{m.eta, reflectance, transmittance}};
}

Bsdf resolve(const PlasticMaterial& m, glm::vec2 uv) {
    return {Plastic(*m.coating, m.eta, m.facets, m.specular_reflectance.evaluate(uv),
                    m.diffuse_reflectance.evaluate(uv), m.nonlinear)};
}

std::vector<const Texture*> textures(const DiffuseMaterial& m) {
    return {&m.reflectance};
}
std::vector<const Texture*> textures(const ConductorMaterial& m) {
    return {&m.alpha, &m.specular_reflectance};
}
std::vector<const Texture*> textures(const DielectricMaterial& m) {
    return {&m.specular_reflectance, &m.specular_transmittance};
}

std::vector<const Texture*> textures(const PlasticMaterial& m) {
    return {&m.diffuse_reflectance, &m.specular_reflectance};
}

} // namespace

std::vector<const Texture*> Material::textures() const {
    return std::visit([](const auto& m) { return tessera::textures(m); }, kind);
}

bool Material::is_textured() const {
    const std::vector<const Texture*> all = textures();
    return std::any_of(all.begin(), all.end(), [](const Texture* t) { return !t->is_constant(); });
}

Bsdf Material::resolve(glm::vec2 uv) const {
    return std::visit([&](const auto& m) { return tessera::resolve(m, uv); }, kind);
}

} // namespace tessera
