#pragma once

#include "render/load/load_context.h"
#include "render/load/properties.h"

namespace tessera {

// Readers of the plugins <bsdf type="...">. They leave Material::name to read_bsdf(). All throw LoadError.
Material read_null(LoadContext& context, Properties& p);
Material read_diffuse(LoadContext& context, Properties& p);
Material read_rough_diffuse(LoadContext& context, Properties& p);
Material read_conductor(LoadContext& context, Properties& p);
Material read_rough_conductor(LoadContext& context, Properties& p);
Material read_dielectric(LoadContext& context, Properties& p);
Material read_rough_dielectric(LoadContext& context, Properties& p);
Material read_thin_dielectric(LoadContext& context, Properties& p);
Material read_plastic(LoadContext& context, Properties& p);
Material read_rough_plastic(LoadContext& context, Properties& p);
Material read_polarizing_plastic(LoadContext& context, Properties& p);
Material read_phong(LoadContext& context, Properties& p);
Material read_ward(LoadContext& context, Properties& p);
Material read_diffuse_transmitter(LoadContext& context, Properties& p);
Material read_medium_layer(LoadContext& context, Properties& p);

Material read_principled(LoadContext& context, Properties& p);
Material read_thin_principled(LoadContext& context, Properties& p);

Material read_twosided(LoadContext& context, Properties& p);
Material read_mask(LoadContext& context, Properties& p);
Material read_bump_map(LoadContext& context, Properties& p);
Material read_normal_map(LoadContext& context, Properties& p);

Material read_blend(LoadContext& context, Properties& p);
Material read_mixture(LoadContext& context, Properties& p);
Material read_coating(LoadContext& context, Properties& p);
Material read_rough_coating(LoadContext& context, Properties& p);

/// Reads the BSDF nested in an adapter such as `twosided`. Throws LoadError if there is none.
Material nested_bsdf(LoadContext& context, Properties& p);

/// Reads a fraction that does not depend on wavelength. A coloured constant becomes its luminance, with a note.
Texture grey_parameter(LoadContext& context, Properties& p, std::string_view name, float fallback);

/// Returns a material as a component of another: without opacity and relief, with a note for each.
Material without_adapters(Material material, const Properties& p);

/// Reads an index of refraction: a number, or the name of a material. Throws LoadError for an unknown name.
float index_parameter(Properties& p, std::string_view name, std::string_view fallback);

/// Reads a conductor's index ("material", or "eta" and "k"), relative to the outside ("ext_eta").
ComplexIndex metal_parameter(const LoadContext& context, Properties& p);

/// Reads the roughness of microfacets: "alpha", or "alpha_u" and "alpha_v". Throws LoadError if it is negative.
struct Roughness {
    Texture alpha;
    std::optional<Texture> alpha_v; ///< empty: isotropic
};
Roughness alpha_parameter(LoadContext& context, Properties& p);

/// Reads the roughness for a BSDF that is isotropic in Tessera. Anisotropic roughness is averaged, with a note.
Texture isotropic_alpha_parameter(LoadContext& context, Properties& p);

/// Reads the distribution of microfacets. Unknown ones are replaced, with a note.
MicrofacetDistribution distribution_parameter(Properties& p);

} // namespace tessera
