#pragma once

#include "render/paths/shift.h"

namespace tessera::test {

/// Shifts all light paths of a base path to the x_1 of another one, lane 0 of `paths`. Returns whether a new edge
/// is blocked.
/// @param trace_edges  false: all new edges count as free
inline bool shift_to_one(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                         const LightPaths& light, const BasePath& other, OffsetPaths& paths,
                         bool trace_edges = false) {
    Shift shift(tracer, settings);
    PrimaryVertices primary;
    primary.reset(1);
    primary.set_pixel(0, other);
    PendingEdges edges;
    edges.reset(1);
    OutcomeLanes outcomes;
    LaneMask blocked;
    paths.reset(light.slot_count(), 1);
    shift.run(base, light, primary, -1, paths, edges, outcomes);
    if (trace_edges)
        edges.resolve(tracer, paths, blocked);
    return blocked[0] != 0;
}

} // namespace tessera::test
