#pragma once

#include "render/load/load_context.h"

namespace tessera {

/// A <bsdf>. An unknown plugin becomes a diffuse marking colour, with a note.
Material read_bsdf(LoadContext& context, const XmlElement& element);

/// The index in scene.materials of a <bsdf>, which is read when it is met for the first time.
int material_of(LoadContext& context, const XmlElement& element);

/// The index of the material of a shape that names none: grey, or black where the shape gives light.
int default_material(LoadContext& context, bool gives_light);

} // namespace tessera
