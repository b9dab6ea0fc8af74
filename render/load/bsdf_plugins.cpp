#include "render/load/bsdf_plugins.h"

#include "render/load/bsdf_readers.h"
#include "render/load/plugin_table.h"
#include "render/load/texture_plugins.h"

namespace tessera {

namespace {

// A plugin adds its row here, its reader, and its alternative to Material::kind where it needs one.
constexpr Plugin<Material (*)(LoadContext&, Properties&)> plugins[] = {
    {"diffuse", read_diffuse},
    {"roughdiffuse", read_rough_diffuse},
    {"conductor", read_conductor},
    {"roughconductor", read_rough_conductor},
    {"dielectric", read_dielectric},
    {"roughdielectric", read_rough_dielectric},
    {"thindielectric", read_thin_dielectric},
    {"plastic", read_plastic},
    {"roughplastic", read_rough_plastic},
    {"phong", read_phong},
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
