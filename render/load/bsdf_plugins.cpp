#include "render/load/bsdf_plugins.h"

#include "render/load/plugin_table.h"
#include "render/load/refraction_indices.h"
#include "render/load/texture_plugins.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace tessera {

namespace {

Material read_diffuse(LoadContext& context, Properties& p) {
    DiffuseMaterial diffuse;
    diffuse.reflectance = reflectance_parameter(context, p, "reflectance", Rgb(0.5f));
    return {{}, diffuse};
}

/// A number, or the name of a material.
float index_parameter(Properties& p, std::string_view name, std::string_view fallback) {
    const auto element = p.take(name);
    if (!element)
        return *refraction_index(fallback);
    if (element->tag() != "string") {
        const float value = p.number(name, 1);
        if (!(value > 0))
            element->fail("an index of refraction must be above 0", "value");
        return value;
    }
    const std::string material = element->required("value");
    const auto index = refraction_index(material);
    if (!index)
        element->fail("the index of refraction of '" + material + "' is not known", "value");
    return *index;
}

Material read_dielectric(LoadContext& context, Properties& p) {
    DielectricMaterial dielectric;
    dielectric.eta = index_parameter(p, "int_ior", "bk7") / index_parameter(p, "ext_ior", "air");
    dielectric.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    dielectric.specular_transmittance = reflectance_parameter(context, p, "specular_transmittance", Rgb(1));
    return {{}, dielectric};
}

Material read_thin_dielectric(LoadContext& context, Properties& p) {
    Material material = read_dielectric(context, p);
    std::get<DielectricMaterial>(material.kind).thin = true;
    return material;
}

/// The index of the metal, relative to what is around it.
ComplexIndex metal_parameter(const LoadContext& context, Properties& p) {
    const bool given = p.has("eta") || p.has("k");
    const std::string fallback = given || !context.old_syntax ? "none" : "Cu";
    const std::string material = p.text("material", fallback);
    auto index = metal_index(material);
    if (!index) {
        p.note(*p.take("material"), "the metal '" + material + "' is not known and replaced by 'none', a mirror");
        index = metal_index("none");
    }
    const float outside = index_parameter(p, "ext_eta", context.old_syntax ? "air" : "vacuum");
    if (!given && material == "none")
        return *index;
    index->eta = p.color("eta", index->eta) / outside;
    index->k = p.color("k", index->k) / outside;
    return *index;
}

Texture alpha_parameter(LoadContext& context, Properties& p) {
    if (p.has("alpha_u") || p.has("alpha_v")) {
        const float u = p.number("alpha_u", 0.1f);
        const float v = p.number("alpha_v", 0.1f);
        if (u < 0 || v < 0)
            p.element().fail("'alpha_u' and 'alpha_v' must not be negative");
        if (u != v)
            p.note("the anisotropic roughness is replaced by its geometric mean");
        return Rgb(std::sqrt(u * v));
    }
    const Texture alpha = texture_parameter(context, p, "alpha", Rgb(0.1f));
    const Rgb* constant = std::get_if<Rgb>(&alpha.kind);
    if (constant && constant->r < 0)
        p.take("alpha")->fail("'alpha' must not be negative", "value");
    return alpha;
}

MicrofacetDistribution distribution_parameter(Properties& p) {
    const std::string name = p.text("distribution", "beckmann");
    if (name == "ggx")
        return MicrofacetDistribution::ggx;
    if (name != "beckmann")
        p.note(*p.take("distribution"), "the distribution '" + name + "' is replaced by 'beckmann'");
    return MicrofacetDistribution::beckmann;
}

ConductorMaterial smooth_part(LoadContext& context, Properties& p) {
    ConductorMaterial conductor;
    const ComplexIndex index = metal_parameter(context, p);
    conductor.eta = index.eta;
    conductor.k = index.k;
    conductor.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    return conductor;
}

Material read_conductor(LoadContext& context, Properties& p) {
    return {{}, smooth_part(context, p)};
}

Material read_rough_conductor(LoadContext& context, Properties& p) {
    ConductorMaterial conductor = smooth_part(context, p);
    conductor.alpha = alpha_parameter(context, p);
    conductor.distribution = distribution_parameter(p);
    p.ignore({"sample_visible"}); // visible normals are always sampled
    return {{}, conductor};
}

/// What plastic and roughplastic share, a coating of roughness `alpha`.
Material plastic_of(LoadContext& context, Properties& p, Microfacets facets) {
    PlasticMaterial plastic;
    plastic.eta = index_parameter(p, "int_ior", "polypropylene") / index_parameter(p, "ext_ior", "air");
    plastic.nonlinear = p.boolean("nonlinear", false);
    plastic.facets = facets;
    plastic.coating = std::make_shared<const Coating>(plastic.eta, facets.distribution, facets.alpha);
    plastic.diffuse_reflectance = reflectance_parameter(context, p, "diffuse_reflectance", Rgb(0.5f));
    plastic.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    return {{}, plastic};
}

Material read_plastic(LoadContext& context, Properties& p) {
    return plastic_of(context, p, {MicrofacetDistribution::beckmann, 0});
}

Material read_rough_plastic(LoadContext& context, Properties& p) {
    const Texture alpha = alpha_parameter(context, p);
    if (!alpha.is_constant())
        p.note("the texture of 'alpha' is replaced by 0.1");
    const float constant = alpha.is_constant() ? std::get<Rgb>(alpha.kind).r : 0.1f;
    p.ignore({"sample_visible"}); // visible normals are always sampled
    return plastic_of(context, p, {distribution_parameter(p), std::max(constant, smallest_alpha)});
}

/// The one BSDF nested in an adapter such as `twosided`.
Material nested_bsdf(LoadContext& context, Properties& p) {
    const std::vector<XmlElement> nested = context.take_nested(p, "bsdf");
    if (nested.empty())
        p.element().fail("'" + p.type() + "' needs a nested <bsdf>");
    if (nested.size() > 1)
        p.note(nested[1], "only the first <bsdf> in '" + p.type() + "' is used");
    return read_bsdf(context, nested[0]);
}

Material read_twosided(LoadContext& context, Properties& p) {
    Material material = nested_bsdf(context, p);
    if (std::holds_alternative<DielectricMaterial>(material.kind))
        p.note("'twosided' means nothing around a transparent material");
    else
        material.two_sided = true;
    return material;
}

// A plugin adds its row here, and its alternative to Material::kind where it needs one.
constexpr Plugin<Material (*)(LoadContext&, Properties&)> plugins[] = {
    {"diffuse", read_diffuse},
    {"conductor", read_conductor},
    {"roughconductor", read_rough_conductor},
    {"dielectric", read_dielectric},
    {"thindielectric", read_thin_dielectric},
    {"plastic", read_plastic},
    {"roughplastic", read_rough_plastic},
    {"twosided", read_twosided},
};

} // namespace

Material read_bsdf(LoadContext& context, const XmlElement& element) {
    const NestingGuard guard(context, element);
    Properties properties(element, context.notes);
    Material material{{}, DiffuseMaterial{marking_color}, true};
    if (const auto* plugin = find_plugin(plugins, properties.type())) {
        material = plugin->read(context, properties);
        properties.report_unused();
    } else {
        properties.note("the bsdf '" + properties.type() + "' is not known; diffuse magenta stands for it");
    }
    material.name = properties.name();
    return material;
}

int material_of(LoadContext& context, const XmlElement& element) {
    const auto known = context.materials.find(element.key());
    if (known != context.materials.end())
        return known->second;
    const int index = static_cast<int>(context.scene.materials.size());
    context.scene.materials.push_back(read_bsdf(context, element));
    context.materials[element.key()] = index;
    return index;
}

int default_material(LoadContext& context, bool gives_light) {
    static const char none[2] = {}; // keys that no element has
    const void* const key = &none[gives_light ? 1 : 0];
    const auto [entry, is_new] =
        context.materials.try_emplace(key, static_cast<int>(context.scene.materials.size()));
    if (is_new)
        context.scene.materials.push_back({"default", DiffuseMaterial{Rgb(gives_light ? 0.0f : 0.5f)}, false});
    return entry->second;
}

} // namespace tessera
