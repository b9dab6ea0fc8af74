#pragma once

#include "render/paths/base_path.h"

#include <optional>

namespace tessera::test {

/// The path with only one of its light paths left alive, a slot of LightPaths.
BasePath isolated(const BasePath& path, const ShiftSettings& settings, int slot);

/// One light path of `base`, taken to the pixel of `other`, as a base path that this pixel could have
/// traced itself: vertices, directions and the densities of its own samplers. It goes the way of
/// render/paths/shift.cpp, but keeps no ratios, Jacobians or weights, so that these can be judged by what the
/// same light path is worth seen from the other pixel. New edges are not checked. Empty: there is no such path.
std::optional<BasePath> shifted(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                                int slot, const BasePath& other);

} // namespace tessera::test
