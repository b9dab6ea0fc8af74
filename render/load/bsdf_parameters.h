#pragma once

#include "render/load/load_context.h"
#include "render/load/refraction_indices.h"

namespace tessera {

/// An index of refraction: a number, or the name of a material. Throws LoadError for an unknown name.
float index_parameter(Properties& p, std::string_view name, std::string_view fallback);

/// The index of the metal ("material", or "eta" and "k"), relative to what is around it ("ext_eta").
ComplexIndex metal_parameter(const LoadContext& context, Properties& p);

/// "alpha", the roughness of microfacets; anisotropic ones are averaged, with a note. Throws LoadError below 0.
Texture alpha_parameter(LoadContext& context, Properties& p);

/// "distribution" of microfacets; unknown ones are replaced, with a note.
MicrofacetDistribution distribution_parameter(Properties& p);

} // namespace tessera
