#include "render/scene/scene.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <variant>

namespace tessera {

namespace {

constexpr float glossy_alpha = 0.1f; // upper bound of a glossy lobe's alpha

template <class... Ts>
struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

float min_red(const Bitmap& bitmap) {
    float smallest = std::numeric_limits<float>::max();
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x)
            smallest = std::min(smallest, bitmap.texel(x, y).r);
    return smallest;
}

/// Returns the smallest value of the red channel anywhere on a texture.
float min_red(const Texture& texture) {
    const float smallest =
        std::visit(Overloaded{[](const Rgb& constant) { return constant.r; },
                              [](const BitmapTexture& b) { return b.bitmap ? min_red(*b.bitmap) : 0.0f; },
                              [](const CheckerboardTexture& c) { return std::min(c.color0.r, c.color1.r); },
                              [](const AttributeTexture&) { return 0.0f; }},
                   texture.kind);
    return texture.is_constant() ? smallest : smallest * texture.scale;
}

/// The kinds of lobes of a material.
struct Lobes {
    bool delta = false;
    bool glossy = false;
    bool transmission = false;
};

/// Classifies microfacets whose smallest alpha is `min_alpha`.
Lobes microfacet_lobes(float min_alpha, bool constant) {
    const bool delta = min_alpha <= 0;
    return {delta, min_alpha < glossy_alpha && !(delta && constant), false};
}

Lobes lobes_of(const Material& m);

Lobes lobes(const DiffuseMaterial&) {
    return {};
}
/// Classifies the microfacets of a ConductorMaterial or DielectricMaterial.
template <class M>
Lobes facet_lobes(const M& m) {
    if (!m.alpha_v)
        return microfacet_lobes(min_red(m.alpha), m.alpha.is_constant());
    const float u = min_red(m.alpha), v = min_red(*m.alpha_v);
    const float min_alpha = std::max(u, v) > 0 ? Microfacets::anisotropic(m.distribution, u, v).alpha : 0;
    return microfacet_lobes(min_alpha, m.alpha.is_constant() && m.alpha_v->is_constant());
}
Lobes lobes(const ConductorMaterial& m) {
    return facet_lobes(m);
}
Lobes lobes(const DielectricMaterial& m) {
    Lobes all = m.thin ? Lobes{true} : facet_lobes(m);
    all.transmission = true;
    return all;
}
Lobes lobes(const PlasticMaterial& m) {
    return microfacet_lobes(m.facets.alpha, true);
}

Lobes lobes(const PhongMaterial&) {
    return {}; // counts as diffuse, whatever its exponent
}
Lobes both(const Lobes& a, const Lobes& b) {
    return {a.delta || b.delta, a.glossy || b.glossy, a.transmission || b.transmission};
}
Lobes lobes(const MixtureMaterial& m) {
    Lobes all;
    for (const auto& part : m.parts)
        all = both(all, lobes_of(*part));
    return all;
}
Lobes lobes(const CoatedMaterial& m) {
    Lobes all = lobes_of(*m.base);
    all.delta = true; // of the coating
    return all;
}

Lobes lobes(const PrincipledMaterial& m) {
    const float rough = min_red(m.roughness);
    return {false, rough * rough < glossy_alpha || !m.clearcoat.is_black(), !m.spec_trans.is_black()};
}
Lobes lobes(const ThinPrincipledMaterial& m) {
    const float rough = min_red(m.roughness);
    return {false, !m.spec_trans.is_black() && rough * rough < glossy_alpha,
            !m.spec_trans.is_black() || !m.diff_trans.is_black()};
}

Lobes lobes(const WardMaterial&) {
    return {}; // counts as diffuse, whatever its alpha
}
Lobes lobes(const DiffuseTransmitterMaterial&) {
    return {false, false, true};
}
Lobes lobes(const MediumLayerMaterial&) {
    return {true, false, true};
}

Lobes lobes_of(const Material& m) {
    const Lobes front = std::visit([](const auto& kind) { return lobes(kind); }, m.kind);
    return m.back ? both(front, lobes_of(*m.back)) : front;
}

bool looks_up_attributes(const Material& m) {
    const std::vector<const Texture*> all = m.textures();
    return std::any_of(all.begin(), all.end(),
                       [](const Texture* t) { return std::holds_alternative<AttributeTexture>(t->kind); });
}

void add(const Material& m, SceneTraits& traits) {
    const Lobes l = lobes_of(m);
    traits.delta_lobes += l.delta;
    traits.glossy_lobes += l.glossy;
    traits.transmission += l.transmission;
    traits.textures += m.is_textured();
    traits.mesh_attributes += looks_up_attributes(m);
    traits.relief += m.relief.has_value() || (m.back && m.back->relief.has_value());
    traits.masks += m.is_mask();
}

} // namespace

SceneTraits traits_of(const SceneDescription& scene) {
    SceneTraits traits;
    std::vector<bool> used(scene.materials.size());
    for_each_shape(scene, [&](const Shape& shape) {
        used[shape.material] = true;
        traits.shading_normals += !shape.mesh.normals.empty();
        traits.area_lights += shape.area_light >= 0;
    });
    traits.instances = static_cast<int>(scene.instances.size());
    traits.point_lights = static_cast<int>(scene.point_lights.size() + scene.directional_lights.size());
    traits.environment = !scene.environment.empty();
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i])
            add(scene.materials[i], traits);
    return traits;
}

} // namespace tessera
