#pragma once

#include "render/load/load_context.h"

namespace tessera {

/// An <integrator>: of its settings only the depth belongs to the scene; methods are chosen in the program.
void read_integrator(LoadContext& context, const XmlElement& element);

/// A <sensor> with its film: camera and size.
void read_sensor(LoadContext& context, const XmlElement& element);

} // namespace tessera
