#pragma once

#include "render/paths/base_path.h"

#include <optional>

namespace tessera::test {

/// Returns the path with only one of its light paths, a slot of LightPaths; the others are black.
BasePath isolated(const BasePath& path, const ShiftSettings& settings, int slot);

/// Shifts one light path of `base` to the pixel of `other`. Returns a base path that this pixel could have traced
/// itself, with its own densities; empty if the shift fails. It follows render/paths/shift.cpp without ratios,
/// Jacobians and weights, and so provides independent values of them. It traces no new edges.
std::optional<BasePath> shifted(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                                int slot, const BasePath& other);

} // namespace tessera::test
