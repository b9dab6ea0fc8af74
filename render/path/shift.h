#pragma once

#include "render/path/light_paths.h"
#include "render/path/pending_edges.h"

namespace tessera {

/// Shifts all light paths of a base path to the pixel that sees `primary`, column `offset` of `paths`, by the kind
/// of shift in `settings`, but for random replay all the way (PathReuse): until base and offset can be connected,
/// half vectors are copied [Bauszat 2017, 3.1] or random numbers replayed [Hua 2019, 3.1]. New edges are added to
/// `edges`, unchecked. Returns ok, or why the first light path that failed did so.
ShiftOutcome shift(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                   const LightPaths& light, const Vertex& primary, int offset, OffsetPaths& paths,
                   PendingEdges& edges);

} // namespace tessera
