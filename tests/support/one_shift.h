#pragma once

#include "render/paths/shift.h"

namespace tessera::test {

/// Shifts all light paths of a base path to what another one sees, lane 0 of `paths`. New edges are taken
/// for free, or traced with `trace_edges`. Returns whether one was blocked.
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
    LaneMask lost;
    paths.reset(light.slot_count(), 1);
    shift.run(base, light, primary, -1, paths, edges, outcomes);
    if (trace_edges)
        edges.resolve(tracer, paths, lost);
    return lost[0] != 0;
}

} // namespace tessera::test
