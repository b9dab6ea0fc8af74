#pragma once

#include "render/surface/material.h"

#include <cmath>
#include <functional>
#include <list>
#include <memory>
#include <ostream>
#include <random>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

/// A BSDF to test.
struct Case {
    const char* name;
    std::function<Bsdf()> bsdf; ///< constructs it only for tests that run, because some have tables
    float eta = 1;              ///< index below the surface over the index above; 1: does not refract
    bool is_sheet = false;      ///< transmits without refraction
    bool has_reciprocal_transmission = true;

    /// Returns the index on the side of d, relative to the index above the surface.
    float index(glm::vec3 d) const { return d.z > 0 ? 1 : eta; }
};

inline void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

inline glm::vec3 direction(float theta, float phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Random numbers in [0, 1).
class Uniform {
public:
    explicit Uniform(unsigned seed) : engine_(seed) {}
    float operator()() { return uniform_(engine_); }
    glm::vec2 two() {
        const float x = uniform_(engine_);
        return {x, uniform_(engine_)};
    }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<float> uniform_{0, 0x1.fffffep-1f};
};

inline std::optional<BsdfSample> draw(const Bsdf& bsdf, glm::vec3 to_previous, Uniform& uniform) {
    const float lobe = uniform();
    return bsdf.sample(to_previous, lobe, uniform.two());
}

inline const Rgb copper_eta(0.200438f, 0.924033f, 1.10221f);
inline const Rgb copper_k(3.91295f, 2.45285f, 2.14219f);

inline RoughConductor rough(MicrofacetDistribution d, float alpha, Rgb eta = copper_eta, Rgb k = copper_k) {
    return {{d, alpha}, eta, k, Rgb(1)};
}

/// Returns anisotropic microfacets that are rougher along the bitangent.
inline Microfacets brushed(MicrofacetDistribution d) {
    return Microfacets::anisotropic(d, 0.15f, 0.5f);
}

/// Returns a plastic. Its coating lives until the program ends.
inline Plastic plastic(MicrofacetDistribution d, float alpha, Rgb diffuse, bool nonlinear) {
    static std::list<Coating> coatings;
    coatings.emplace_back(1.5f, d, alpha);
    return Plastic(coatings.back(), {d, alpha}, Rgb(1), diffuse, nonlinear);
}

template <class Kind>
std::shared_ptr<const Material> shared(Kind kind) {
    return std::make_shared<const Material>(Material{{}, kind});
}

inline ConductorMaterial copper(float alpha) {
    return {MicrofacetDistribution::ggx, {Rgb(alpha)}, copper_eta, copper_k};
}

inline DielectricMaterial glass(float alpha, float eta = 1.5f) {
    DielectricMaterial m;
    m.eta = eta;
    m.distribution = MicrofacetDistribution::ggx;
    m.alpha = Texture(Rgb(alpha));
    return m;
}

inline MixtureMaterial blend(std::shared_ptr<const Material> a, std::shared_ptr<const Material> b,
                             float blend_weight) {
    MixtureMaterial m{{std::move(a), std::move(b)}};
    m.blend_weight = Texture(Rgb(blend_weight));
    return m;
}

inline CoatedMaterial coated(std::shared_ptr<const Material> base, Rgb sigma_a, Rgb specular = Rgb(1)) {
    return {1.5f, 0.7f, {sigma_a}, {specular}, std::move(base)};
}

/// Returns a principled material with all lobes.
inline PrincipledMaterial principled(float metallic, float spec_trans) {
    PrincipledMaterial m;
    m.base_color = Texture(Rgb(0.8f, 0.4f, 0.2f));
    m.roughness = Texture(Rgb(0.4f));
    m.anisotropic = Texture(Rgb(0.6f));
    m.metallic = Texture(Rgb(metallic));
    m.spec_trans = Texture(Rgb(spec_trans));
    m.spec_tint = Texture(Rgb(0.5f));
    m.sheen = Texture(Rgb(0.6f));
    m.sheen_tint = Texture(Rgb(0.4f));
    m.flatness = Texture(Rgb(0.3f));
    m.clearcoat = Texture(Rgb(0.8f));
    m.clearcoat_gloss = Texture(Rgb(0.2f));
    return m;
}

inline ThinPrincipledMaterial thin_principled(float spec_trans, float diff_trans) {
    ThinPrincipledMaterial m;
    m.base_color = Texture(Rgb(0.8f, 0.4f, 0.2f));
    m.roughness = Texture(Rgb(0.6f));
    m.anisotropic = Texture(Rgb(0.4f));
    m.spec_trans = Texture(Rgb(spec_trans));
    m.eta = Texture(Rgb(1.4f));
    m.spec_tint = Texture(Rgb(0.5f));
    m.sheen = Texture(Rgb(0.6f));
    m.sheen_tint = Texture(Rgb(0.3f));
    m.flatness = Texture(Rgb(0.3f));
    m.diff_trans = Texture(Rgb(diff_trans));
    return m;
}

/// Returns the BSDF of a material, which lives until the program ends.
template <class Kind>
Bsdf resolved(Kind kind) {
    static std::list<Material> materials;
    materials.push_back({{}, std::move(kind)});
    return materials.back().resolve({});
}

} // namespace tessera::test
