#pragma once

#include "render/method/inspection.h"
#include "ui/scene_lines.h"
#include "ui/shift_outcomes.h"

#include <vector>

namespace tessera {

/// The colour that stands for how the shift ended; grey where it was not tried.
ImU32 outcome_colour(const InspectedShift& shift);

/// Draws shifted paths in the colours of their outcomes; the more of the light one brings, the plainer it is.
/// @param marked  the one that stands out; -1: none does
void draw_shifts(const SceneLines& lines, const std::vector<const InspectedShift*>& shifts, int marked);

/// Draws a base path in white with its vertices' names, and its light samples in yellow.
/// @param far  how long a way to infinity is drawn, units of the scene
void draw_base_path(const SceneLines& lines, const std::vector<InspectedVertex>& path, float far);

} // namespace tessera
