#include "render/scene/material.h"

#include <algorithm>

namespace tessera {

namespace {

Bsdf resolve(const DiffuseMaterial& m, const SurfacePoint& at) {
    return {Diffuse{m.reflectance.evaluate(at)}};
}

Bsdf resolve(const ConductorMaterial& m, const SurfacePoint& at) {
    const float alpha = m.alpha.evaluate(at).r;
    const Rgb specular_reflectance = m.specular_reflectance.evaluate(at);
    if (alpha <= 0)
        return {SmoothConductor{m.eta, m.k, specular_reflectance}};
    return {RoughConductor{{m.distribution, std::max(alpha, smallest_alpha)}, m.eta, m.k, specular_reflectance}};
}

Bsdf resolve(const DielectricMaterial& m, const SurfacePoint& at) {
    const Rgb reflectance = m.specular_reflectance.evaluate(at),
              transmittance = m.specular_transmittance.evaluate(at);
    if (m.thin)
        return {ThinDielectric{m.eta, reflectance, transmittance}};
    return {SmoothDielectric{m.eta, reflectance, transmittance}};
}

Bsdf resolve(const PlasticMaterial& m, const SurfacePoint& at) {
    return {Plastic(*m.coating, m.eta, m.facets, m.specular_reflectance.evaluate(at),
                    m.diffuse_reflectance.evaluate(at), m.nonlinear)};
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
    std::vector<const Texture*> all = std::visit([](const auto& m) { return tessera::textures(m); }, kind);
    if (opacity)
        all.push_back(&*opacity);
    if (relief)
        all.push_back(&relief->map);
    return all;
}

bool Material::is_textured() const {
    const std::vector<const Texture*> all = textures();
    return std::any_of(all.begin(), all.end(), [](const Texture* t) { return !t->is_constant(); });
}

Bsdf Material::resolve(const SurfacePoint& at) const {
    return std::visit([&](const auto& m) { return tessera::resolve(m, at); }, kind);
}

} // namespace tessera
