#pragma once

#include "render/load/load_context.h"

#include <vector>

namespace tessera {

// One reader for each plugin <bsdf type="...">. They name nothing: that is left to read_bsdf(). All throw
// LoadError.
Material read_diffuse(LoadContext& context, Properties& p);
Material read_rough_diffuse(LoadContext& context, Properties& p);
Material read_conductor(LoadContext& context, Properties& p);
Material read_rough_conductor(LoadContext& context, Properties& p);
Material read_dielectric(LoadContext& context, Properties& p);
Material read_rough_dielectric(LoadContext& context, Properties& p);
Material read_thin_dielectric(LoadContext& context, Properties& p);
Material read_plastic(LoadContext& context, Properties& p);
Material read_rough_plastic(LoadContext& context, Properties& p);
Material read_phong(LoadContext& context, Properties& p);

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

} // namespace tessera
