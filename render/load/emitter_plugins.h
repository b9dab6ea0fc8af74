#pragma once

#include "render/load/load_context.h"

namespace tessera {

/// The index in scene.area_lights of the <emitter> nested in a shape, -1 when it is none that a shape can be.
int add_shape_emitter(LoadContext& context, const XmlElement& element);

/// An <emitter> that belongs to no shape.
void add_scene_emitter(LoadContext& context, const XmlElement& element);

} // namespace tessera
