#pragma once

#include "render/load/load_context.h"

namespace tessera {

/// Adds a <shape> to the scene; one of an unknown plugin is left out, with a note.
void add_shape(LoadContext& context, const XmlElement& element);

} // namespace tessera
