#include "render/load/bsdf_readers.h"
#include "render/load/plugins.h"

#include <cctype>
#include <cmath>
#include <string>
#include <tuple>
#include <variant>

namespace tessera {

namespace {

// A new plugin adds its row here, its reader, and an alternative of Material::kind if it needs one.
constexpr Plugin<Material (*)(LoadContext&, Properties&)> plugins[] = {
    {"null", read_null},
    {"diffuse", read_diffuse},
    {"roughdiffuse", read_rough_diffuse},
    {"conductor", read_conductor},
    {"roughconductor", read_rough_conductor},
    {"dielectric", read_dielectric},
    {"roughdielectric", read_rough_dielectric},
    {"thindielectric", read_thin_dielectric},
    {"plastic", read_plastic},
    {"roughplastic", read_rough_plastic},
    {"pplastic", read_polarizing_plastic},
    {"phong", read_phong},
    {"ward", read_ward},
    {"difftrans", read_diffuse_transmitter},
    {"hk", read_medium_layer},
    {"principled", read_principled},
    {"principledthin", read_thin_principled},
    {"twosided", read_twosided},
    {"mask", read_mask},
    {"bumpmap", read_bump_map},
    {"normalmap", read_normal_map},
    {"blendbsdf", read_blend},
    {"mixturebsdf", read_mixture},
    {"coating", read_coating},
    {"roughcoating", read_rough_coating},
};

} // namespace

Material read_bsdf(LoadContext& context, const XmlElement& element) {
    if (const auto known = context.bsdfs.find(element.key()); known != context.bsdfs.end())
        return known->second;
    const NestingGuard guard(context, element);
    Properties properties(element, context.notes);
    Material material{{}, DiffuseMaterial{marking_color}, true};
    if (const auto* plugin = find_plugin(plugins, properties.type())) {
        material = plugin->read(context, properties);
        properties.report_unused();
    } else {
        properties.note("the bsdf '" + properties.type() + "' is not known; diffuse magenta is used instead");
    }
    material.name = properties.name();
    return context.bsdfs.emplace(element.key(), material).first->second;
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

int default_material(LoadContext& context, bool emits_light) {
    static const char none[2] = {}; // addresses that no element has as its key
    const void* const key = &none[emits_light ? 1 : 0];
    const auto [entry, is_new] =
        context.materials.try_emplace(key, static_cast<int>(context.scene.materials.size()));
    if (is_new)
        context.scene.materials.push_back({"default", DiffuseMaterial{Rgb(emits_light ? 0.0f : 0.5f)}, false});
    return entry->second;
}

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

ComplexIndex metal_parameter(const LoadContext& context, Properties& p) {
    const bool given = p.has("eta") || p.has("k");
    const std::string fallback = context.old_syntax ? "Cu" : "none"; // Mitsuba's default
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

namespace {

Texture one_alpha(LoadContext& context, Properties& p, std::string_view name) {
    const Texture alpha = texture_parameter(context, p, name, Rgb(0.1f));
    const Rgb* constant = std::get_if<Rgb>(&alpha.kind);
    if (constant && constant->r < 0)
        p.take(name)->fail("'" + std::string(name) + "' must not be negative", "value");
    return alpha;
}

} // namespace

Roughness alpha_parameter(LoadContext& context, Properties& p) {
    if (!p.has("alpha_u") && !p.has("alpha_v"))
        return {one_alpha(context, p, "alpha"), {}};
    Roughness roughness{one_alpha(context, p, "alpha_u"), one_alpha(context, p, "alpha_v")};
    const Rgb *u = std::get_if<Rgb>(&roughness.alpha.kind), *v = std::get_if<Rgb>(&roughness.alpha_v->kind);
    if (u && v && u->r == v->r)
        roughness.alpha_v.reset();
    return roughness;
}

Texture isotropic_alpha_parameter(LoadContext& context, Properties& p) {
    const Roughness roughness = alpha_parameter(context, p);
    if (!roughness.alpha_v)
        return roughness.alpha;
    if (!roughness.alpha.is_constant() || !roughness.alpha_v->is_constant()) {
        p.note("the anisotropic roughness is replaced by 'alpha_u'");
        return roughness.alpha;
    }
    p.note("the anisotropic roughness is replaced by its geometric mean");
    return Rgb(std::sqrt(std::get<Rgb>(roughness.alpha.kind).r * std::get<Rgb>(roughness.alpha_v->kind).r));
}

MicrofacetDistribution distribution_parameter(Properties& p) {
    std::string name = p.text("distribution", "beckmann");
    for (char& c : name)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (name == "ggx")
        return MicrofacetDistribution::ggx;
    if (name == "phong" || name == "as")
        // In both, the exponent follows from alpha so that the shapes are similar [Walter 2007, 5.2].
        p.note(*p.take("distribution"),
               "the distribution '" + name + "' is replaced by 'beckmann' of the same 'alpha'");
    else if (name != "beckmann")
        p.note(*p.take("distribution"), "the distribution '" + name + "' is replaced by 'beckmann'");
    return MicrofacetDistribution::beckmann;
}

} // namespace tessera
