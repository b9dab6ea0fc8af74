#pragma once

#include "render/load/load_context.h"
#include "render/load/properties.h"

namespace tessera {

// There is one reader for each plugin <bsdf type="...">. They name nothing: that is left to read_bsdf(). All throw
// LoadError.
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

/// The one BSDF nested in an adapter such as `twosided`. Throws LoadError where there is none.
Material nested_bsdf(LoadContext& context, Properties& p);

/// A share that does not depend on the colour of light: the luminance of a coloured constant, with a note.
Texture grey_parameter(LoadContext& context, Properties& p, std::string_view name, float fallback);

/// A material as part of another: its opacity and its relief are dropped, with a note.
Material without_adapters(Material material, const Properties& p);

/// An index of refraction: a number, or the name of a material. Throws LoadError for an unknown name.
float index_parameter(Properties& p, std::string_view name, std::string_view fallback);

/// The index of the metal ("material", or "eta" and "k"), relative to what is around it ("ext_eta").
ComplexIndex metal_parameter(const LoadContext& context, Properties& p);

/// The roughness of microfacets: "alpha", or "alpha_u" and "alpha_v". Throws LoadError below 0.
struct Roughness {
    Texture alpha;
    std::optional<Texture> alpha_v; ///< nothing: as alpha
};
Roughness alpha_parameter(LoadContext& context, Properties& p);

/// The same for what is isotropic here: other roughness is averaged, with a note.
Texture isotropic_alpha_parameter(LoadContext& context, Properties& p);

/// "distribution" of microfacets; unknown ones are replaced, with a note.
MicrofacetDistribution distribution_parameter(Properties& p);

} // namespace tessera
