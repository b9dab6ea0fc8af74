#include "render/io/text.h"
#include "render/load/bsdf_readers.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

namespace tessera {

// Adapters, which modify one nested BSDF.

Material nested_bsdf(LoadContext& context, Properties& p) {
    const std::optional<XmlElement> nested = context.take_one_nested(p, "bsdf");
    if (!nested)
        p.element().fail("'" + p.type() + "' needs a nested <bsdf>");
    return read_bsdf(context, *nested);
}

namespace {

/// Makes `back` the material of the back. The opacity of the front is that of both sides.
void set_back(Material& front, Material back, const Properties& p) {
    if (back.is_transparent()) {
        p.note("the transparent back of 'twosided' is left out");
        return;
    }
    if (back.opacity)
        p.note("the mask on the back of 'twosided' is left out");
    back.opacity.reset();
    back.back.reset();
    if (back.relief)
        back.relief->is_mirrored_behind = true;
    back.two_sided = false; // the front's is that of the material
    front.back = std::make_shared<const Material>(std::move(back));
}

} // namespace

Material read_twosided(LoadContext& context, Properties& p) {
    const std::vector<XmlElement> nested = context.take_nested(p, "bsdf");
    if (nested.empty())
        p.element().fail("'twosided' needs a nested <bsdf>");
    if (nested.size() > 2)
        p.note(nested[2], "only the first two <bsdf> in 'twosided' are used");
    Material material = read_bsdf(context, nested[0]);
    if (material.is_transparent()) {
        p.note("'twosided' has no effect on a transparent material");
        return material;
    }
    material.two_sided = true;
    if (material.relief)
        material.relief->is_mirrored_behind = true;
    if (nested.size() > 1)
        set_back(material, read_bsdf(context, nested[1]), p);
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

/// Returns the opacity of two nested masks. If both are textures, the inner one is left out, with a note.
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

/// Reads the nested texture of an adapter, under any name.
Texture nested_texture(LoadContext& context, Properties& p) {
    const std::optional<XmlElement> nested = context.take_one_nested(p, "texture");
    if (!nested)
        p.element().fail("'" + p.type() + "' needs a nested <texture>");
    return read_texture(context, *nested);
}

void set_relief(const LoadContext& context, Properties& p, Material& material, Relief relief) {
    relief.use_shadowing_function = p.boolean("use_shadowing_function", !context.old_syntax);
    relief.turns_to_viewer = p.boolean("flip_invalid_normals", !context.old_syntax);
    if (material.relief)
        p.note("the bump or normal map inside this one is left out");
    material.relief = relief;
    if (material.back) {
        Material back = *material.back;
        back.relief = relief;
        material.back = std::make_shared<const Material>(std::move(back));
    }
}

} // namespace

Material read_mask(LoadContext& context, Properties& p) {
    Material material = nested_bsdf(context, p);
    const Texture opacity = grey_parameter(context, p, "opacity", 0.5f);
    const Rgb* constant = std::get_if<Rgb>(&opacity.kind);
    if (constant && constant->r >= 1)
        return material; // opaque
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
        p.note("the bump or normal map inside '" + p.type() + "' is left out");
    if (material.back)
        p.note("the second <bsdf> of 'twosided' inside '" + p.type() + "' is left out");
    material.opacity.reset();
    material.relief.reset();
    material.back.reset();
    return material;
}

// Combinations of several BSDFs, or of a BSDF and a layer on it.

namespace {

/// Makes all dielectric components refract like the first one, because transmitted light must have a single
/// direction.
/// @param first the first dielectric; empty until one is met
/// @return whether a component had to be changed
bool share_refraction(Material& material, std::optional<DielectricMaterial>& first) {
    if (auto* dielectric = std::get_if<DielectricMaterial>(&material.kind)) {
        if (!first)
            first = *dielectric;
        const bool differs = dielectric->eta != first->eta || dielectric->thin != first->thin;
        dielectric->eta = first->eta;
        dielectric->thin = first->thin;
        return differs;
    }
    bool changed = false;
    if (auto* mixture = std::get_if<MixtureMaterial>(&material.kind))
        for (std::shared_ptr<const Material>& part : mixture->parts) {
            Material copy = *part;
            changed |= share_refraction(copy, first);
            part = std::make_shared<const Material>(std::move(copy));
        }
    return changed;
}

/// Removes the unscattered transmission of `hk` layers. Beside a refracting component, it would be a second
/// direction.
/// @return whether there was any
bool leave_out_straight_light(Material& material) {
    if (auto* layer = std::get_if<MediumLayerMaterial>(&material.kind))
        return std::exchange(layer->is_clear, false);
    bool changed = false;
    if (auto* mixture = std::get_if<MixtureMaterial>(&material.kind))
        for (std::shared_ptr<const Material>& part : mixture->parts) {
            Material copy = *part;
            changed |= leave_out_straight_light(copy);
            part = std::make_shared<const Material>(std::move(copy));
        }
    return changed;
}

constexpr int max_parts = 256; // each is evaluated at every scattering event; not tuned

/// Counts the BSDFs that a material contains, at any depth. Counting stops soon after max_parts.
int count_parts(const Material& material) {
    if (const auto* coated = std::get_if<CoatedMaterial>(&material.kind))
        return 1 + count_parts(*coated->base);
    const auto* mixture = std::get_if<MixtureMaterial>(&material.kind);
    int count = mixture ? 0 : 1;
    for (std::size_t i = 0; mixture && i < mixture->parts.size() && count <= max_parts; ++i)
        count += count_parts(*mixture->parts[i]);
    return count;
}

/// Returns a mixture of the nested BSDFs, without weights. Throws LoadError for too many: by references, a few
/// lines can make millions.
Material mixture_of(LoadContext& context, Properties& p, const std::vector<XmlElement>& nested) {
    MixtureMaterial mixture;
    std::optional<DielectricMaterial> first;
    std::size_t two_sided = 0;
    for (const XmlElement& element : nested) {
        Material part = without_adapters(read_bsdf(context, element), p);
        two_sided += part.two_sided;
        if (share_refraction(part, first))
            p.note(element, "this refracts like the first transparent <bsdf> in '" + p.type() + "'");
        mixture.parts.push_back(std::make_shared<const Material>(std::move(part)));
    }
    Material material{{}, mixture};
    if (first && !first->thin && leave_out_straight_light(material))
        p.note("the unscattered transmission of 'hk' is left out, because another <bsdf> refracts");
    if (count_parts(material) > max_parts)
        p.element().fail("'" + p.type() + "' is made of more than " + std::to_string(max_parts) +
                         " BSDFs, counting nested ones at each use");
    const bool all_two_sided = two_sided == nested.size();
    if (two_sided > 0 && !all_two_sided)
        p.note("'twosided' around some of the materials in '" + p.type() + "' is left out");
    material.two_sided = all_two_sided;
    return material;
}

/// Reads weights such as "0.3, 0.2", one for each of `count` materials. Scales them to a sum of at most 1.
std::vector<float> weights_parameter(Properties& p, std::size_t count) {
    const auto element = p.take("weights");
    if (!element)
        p.element().fail("'mixturebsdf' needs 'weights'");
    std::string text = element->required("value");
    std::replace(text.begin(), text.end(), ';', ',');
    auto weights = parse_numbers(text);
    if (!weights)
        element->fail("'" + text + "' is not a list of numbers", "value");
    if (weights->size() != count)
        element->fail(std::to_string(weights->size()) + " weights for " + std::to_string(count) + " materials",
                      "value");
    if (std::any_of(weights->begin(), weights->end(), [](float w) { return w < 0; }))
        element->fail("'weights' must not be negative", "value");
    const float sum = std::accumulate(weights->begin(), weights->end(), 0.0f);
    if (!(sum > 0))
        element->fail("one of the 'weights' must be above 0", "value");
    if (sum > 1 + 1e-4f)
        p.note(*element, "'weights' add up to more than 1 and are scaled down to 1");
    if (sum > 1)
        for (float& w : *weights)
            w /= sum;
    return *weights;
}

} // namespace

Material read_blend(LoadContext& context, Properties& p) {
    std::vector<XmlElement> nested = context.take_nested(p, "bsdf");
    if (nested.size() < 2)
        p.element().fail("'blendbsdf' needs two nested <bsdf>");
    if (nested.size() > 2)
        p.note(nested[2], "only the first two <bsdf> in 'blendbsdf' are used");
    nested.resize(2, nested[0]);
    Material material = mixture_of(context, p, nested);
    auto& mixture = std::get<MixtureMaterial>(material.kind);
    mixture.blend_weight = grey_parameter(context, p, "weight", 0.5f);
    return material;
}

Material read_mixture(LoadContext& context, Properties& p) {
    const std::vector<XmlElement> nested = context.take_nested(p, "bsdf");
    if (nested.empty())
        p.element().fail("'mixturebsdf' needs a nested <bsdf>");
    const std::vector<float> weights = weights_parameter(p, nested.size());
    Material material = mixture_of(context, p, nested);
    std::get<MixtureMaterial>(material.kind).weights = weights;
    return material;
}

Material read_coating(LoadContext& context, Properties& p) {
    Material base = without_adapters(nested_bsdf(context, p), p);
    CoatedMaterial coated;
    coated.eta = index_parameter(p, "int_ior", "bk7") / index_parameter(p, "ext_ior", "air");
    coated.thickness = p.number("thickness", 1);
    if (coated.thickness < 0)
        p.take("thickness")->fail("'thickness' must not be negative", "value");
    coated.sigma_a = texture_parameter(context, p, "sigma_a", Rgb(0));
    const Rgb* sigma = std::get_if<Rgb>(&coated.sigma_a.kind);
    if (sigma && (sigma->r < 0 || sigma->g < 0 || sigma->b < 0))
        p.take("sigma_a")->fail("'sigma_a' must not be negative", "value");
    coated.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    if (base.is_transparent()) {
        p.note("the coating around a transparent material is left out");
        return base;
    }
    const bool two_sided = std::exchange(base.two_sided, false);
    if (!two_sided)
        p.note("the back of the coating is black, like that of its base");
    coated.base = std::make_shared<const Material>(std::move(base));
    return {{}, coated, two_sided};
}

Material read_rough_coating(LoadContext& context, Properties& p) {
    p.note("'roughcoating' is replaced by 'coating', which is smooth");
    p.ignore({"alpha", "distribution", "sample_visible"});
    return read_coating(context, p);
}

} // namespace tessera
