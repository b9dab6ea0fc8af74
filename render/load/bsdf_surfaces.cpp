#include "render/load/bsdf_readers.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

namespace tessera {

// BSDFs that contain no other BSDF.

namespace {

/// Returns the name of the reflectance parameter. Mitsuba 0.6 accepts both.
const char* diffuse_name(const Properties& p) {
    return p.has("diffuse_reflectance") && !p.has("reflectance") ? "diffuse_reflectance" : "reflectance";
}

ConductorMaterial smooth_conductor(LoadContext& context, Properties& p) {
    ConductorMaterial conductor;
    const ComplexIndex index = metal_parameter(context, p);
    conductor.eta = index.eta;
    conductor.k = index.k;
    conductor.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    return conductor;
}

/// Reads a plastic whose coating has the given microfacets. With `scatters_once`, light that the coating
/// reflects back to the base is lost.
Material plastic_of(LoadContext& context, Properties& p, Microfacets facets, bool scatters_once = false) {
    PlasticMaterial plastic;
    plastic.scatters_once = scatters_once;
    plastic.eta = index_parameter(p, "int_ior", "polypropylene") / index_parameter(p, "ext_ior", "air");
    plastic.nonlinear = p.boolean("nonlinear", false);
    plastic.facets = facets;
    if (scatters_once) {
        plastic.coating = std::make_shared<const Coating>(Coating::without_bounces(plastic.eta));
    } else {
        auto& coating = context.coatings[{plastic.eta, facets.distribution, facets.alpha}];
        if (!coating)
            coating = std::make_shared<const Coating>(plastic.eta, facets.distribution, facets.alpha);
        plastic.coating = coating;
    }
    plastic.diffuse_reflectance = reflectance_parameter(context, p, "diffuse_reflectance", Rgb(0.5f));
    plastic.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    return {{}, plastic};
}

} // namespace

/// Returns a material of opacity 0. Scenes use it for boundaries of media, which are not rendered and have a
/// note of their own.
Material read_null(LoadContext&, Properties&) {
    return {{}, DiffuseMaterial{Rgb(0)}, true, Texture(Rgb(0))};
}

Material read_diffuse(LoadContext& context, Properties& p) {
    DiffuseMaterial diffuse;
    diffuse.reflectance = reflectance_parameter(context, p, diffuse_name(p), Rgb(0.5f));
    return {{}, diffuse};
}

Material read_rough_diffuse(LoadContext& context, Properties& p) {
    DiffuseMaterial diffuse;
    diffuse.reflectance = reflectance_parameter(context, p, diffuse_name(p), Rgb(0.5f));
    diffuse.alpha = texture_parameter(context, p, "alpha", Rgb(0.2f));
    const Rgb* alpha = std::get_if<Rgb>(&diffuse.alpha.kind);
    if (alpha && alpha->r < 0)
        p.take("alpha")->fail("'alpha' must not be negative", "value");
    diffuse.fast = p.boolean("use_fast_approx", false);
    return {{}, diffuse};
}

Material read_dielectric(LoadContext& context, Properties& p) {
    DielectricMaterial dielectric;
    dielectric.eta = index_parameter(p, "int_ior", "bk7") / index_parameter(p, "ext_ior", "air");
    dielectric.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(1));
    dielectric.specular_transmittance = reflectance_parameter(context, p, "specular_transmittance", Rgb(1));
    return {{}, dielectric};
}

Material read_rough_dielectric(LoadContext& context, Properties& p) {
    Material material = read_dielectric(context, p);
    auto& dielectric = std::get<DielectricMaterial>(material.kind);
    auto [alpha, alpha_v] = alpha_parameter(context, p);
    dielectric.alpha = std::move(alpha);
    dielectric.alpha_v = std::move(alpha_v);
    dielectric.distribution = distribution_parameter(p);
    p.ignore({"sample_visible"}); // visible normals are always sampled
    return material;
}

Material read_thin_dielectric(LoadContext& context, Properties& p) {
    Material material = read_dielectric(context, p);
    std::get<DielectricMaterial>(material.kind).thin = true;
    return material;
}

Material read_conductor(LoadContext& context, Properties& p) {
    return {{}, smooth_conductor(context, p)};
}

Material read_rough_conductor(LoadContext& context, Properties& p) {
    ConductorMaterial conductor = smooth_conductor(context, p);
    auto [alpha, alpha_v] = alpha_parameter(context, p);
    conductor.alpha = std::move(alpha);
    conductor.alpha_v = std::move(alpha_v);
    conductor.distribution = distribution_parameter(p);
    p.ignore({"sample_visible"}); // visible normals are always sampled
    return {{}, conductor};
}

Material read_plastic(LoadContext& context, Properties& p) {
    return plastic_of(context, p, {MicrofacetDistribution::beckmann, 0});
}

namespace {

/// Reads the microfacets of a plastic, which have constant isotropic roughness.
Microfacets facets_parameter(LoadContext& context, Properties& p) {
    const Texture alpha = isotropic_alpha_parameter(context, p);
    if (!alpha.is_constant())
        p.note("the texture of 'alpha' is replaced by 0.1");
    const float constant = alpha.is_constant() ? std::get<Rgb>(alpha.kind).r : 0.1f;
    p.ignore({"sample_visible"}); // visible normals are always sampled
    return {distribution_parameter(p), std::max(constant, smallest_alpha)};
}

} // namespace

Material read_rough_plastic(LoadContext& context, Properties& p) {
    return plastic_of(context, p, facets_parameter(context, p));
}

Material read_polarizing_plastic(LoadContext& context, Properties& p) {
    p.note("the polarisation of 'pplastic' is left out");
    return plastic_of(context, p, facets_parameter(context, p), true);
}

namespace {

/// Notes a diffuse component and a specular lobe that together reflect more than all light.
void note_if_scaled(const Properties& p, const Texture& diffuse, const Texture& specular) {
    if (!diffuse.is_constant() || !specular.is_constant())
        return;
    const Rgb sum = std::get<Rgb>(diffuse.kind) + std::get<Rgb>(specular.kind);
    if (std::max({sum.r, sum.g, sum.b}) > 1)
        p.note("the two reflectances add up to more than 1 and are scaled down to 1");
}

} // namespace

Material read_phong(LoadContext& context, Properties& p) {
    PhongMaterial phong;
    phong.exponent = texture_parameter(context, p, "exponent", Rgb(30));
    const Rgb* exponent = std::get_if<Rgb>(&phong.exponent.kind);
    if (exponent && exponent->r < 0)
        p.take("exponent")->fail("'exponent' must not be negative", "value");
    phong.diffuse_reflectance = reflectance_parameter(context, p, "diffuse_reflectance", Rgb(0.5f));
    phong.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(0.2f));
    note_if_scaled(p, phong.diffuse_reflectance, phong.specular_reflectance);
    return {{}, phong};
}

Material read_ward(LoadContext& context, Properties& p) {
    WardMaterial ward;
    const std::string variant = p.text("variant", "balanced");
    if (variant == "ward")
        ward.variant = WardVariant::ward;
    else if (variant == "ward-duer")
        ward.variant = WardVariant::duer;
    else if (variant != "balanced")
        p.take("variant")->fail("'variant' must be 'ward', 'ward-duer' or 'balanced'", "value");
    auto [alpha, alpha_v] = alpha_parameter(context, p);
    ward.alpha = std::move(alpha);
    ward.alpha_v = std::move(alpha_v);
    ward.diffuse_reflectance = reflectance_parameter(context, p, "diffuse_reflectance", Rgb(0.5f));
    ward.specular_reflectance = reflectance_parameter(context, p, "specular_reflectance", Rgb(0.2f));
    note_if_scaled(p, ward.diffuse_reflectance, ward.specular_reflectance);
    return {{}, ward};
}

} // namespace tessera
