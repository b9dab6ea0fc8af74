// The plugins that change how light meets the one BSDF nested in them.
#include "render/load/bsdf_plugins.h"
#include "render/load/bsdf_readers.h"
#include "render/load/texture_plugins.h"

namespace tessera {

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
    if (material.is_transparent())
        p.note("'twosided' means nothing around a transparent material");
    else
        material.two_sided = true;
    return material;
}

Texture grey_parameter(LoadContext& context, Properties& p, std::string_view name, float fallback) {
    Texture texture = reflectance_parameter(context, p, name, Rgb(fallback));
    if (Rgb* color = std::get_if<Rgb>(&texture.kind)) {
        if (color->r != color->g || color->g != color->b)
            p.note(*p.take(name), "the coloured '" + std::string(name) + "' is replaced by its luminance");
        *color = Rgb(luminance(*color));
    }
    return texture;
}

namespace {

/// What is left of light by two masks, one around the other. At most one of them can be a texture.
Texture product(const Properties& p, const Texture& outer, const Texture& inner) {
    if (!outer.is_constant() && !inner.is_constant()) {
        p.note("the mask inside this one is left out");
        return outer;
    }
    const Texture& factor = outer.is_constant() ? outer : inner;
    Texture result = outer.is_constant() ? inner : outer;
    if (Rgb* constant = std::get_if<Rgb>(&result.kind))
        *constant *= std::get<Rgb>(factor.kind);
    else
        result.scale *= std::get<Rgb>(factor.kind).r;
    return result;
}

/// The texture of an adapter, whatever its name.
Texture nested_texture(LoadContext& context, Properties& p) {
    const std::vector<XmlElement> nested = context.take_nested(p, "texture");
    if (nested.empty())
        p.element().fail("'" + p.type() + "' needs a nested <texture>");
    if (nested.size() > 1)
        p.note(nested[1], "only the first <texture> in '" + p.type() + "' is used");
    return read_texture(context, nested[0]);
}

void set_relief(const LoadContext& context, Properties& p, Material& material, Relief relief) {
    relief.softens_terminator = p.boolean("use_shadowing_function", !context.old_syntax);
    p.ignore({"flip_invalid_normals"}); // what is above one surface and below the other is black here
    if (material.relief)
        p.note("the relief inside this one is left out");
    material.relief = relief;
}

} // namespace

Material read_mask(LoadContext& context, Properties& p) {
    Material material = nested_bsdf(context, p);
    const Texture opacity = grey_parameter(context, p, "opacity", 0.5f);
    const Rgb* constant = std::get_if<Rgb>(&opacity.kind);
    if (constant && constant->r >= 1)
        return material; // nothing is masked
    material.opacity = material.opacity ? product(p, opacity, *material.opacity) : opacity;
    return material;
}

Material read_bump_map(LoadContext& context, Properties& p) {
    Material material = nested_bsdf(context, p);
    Relief relief{Relief::Kind::bump, nested_texture(context, p), p.number("scale", 1)};
    set_relief(context, p, material, relief);
    return material;
}

Material read_normal_map(LoadContext& context, Properties& p) {
    Material material = nested_bsdf(context, p);
    set_relief(context, p, material, {Relief::Kind::normal_map, nested_texture(context, p)});
    return material;
}

Material without_adapters(Material material, const Properties& p) {
    if (material.opacity)
        p.note("the mask inside '" + p.type() + "' is left out");
    if (material.relief)
        p.note("the relief inside '" + p.type() + "' is left out");
    material.opacity.reset();
    material.relief.reset();
    return material;
}

} // namespace tessera
