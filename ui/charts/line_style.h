#pragma once

#include "recon/picture/reconstruct.h"
#include "render/settings/settings.h"

#include <optional>
#include <span>

#include <imgui.h>

namespace tessera {

/// Style of a chart's line, on the screen and in files: the colour shows the method, the dashes show the norm,
/// and the marker any other difference.
struct LineStyle {
    std::optional<Method> method; ///< determines the colour; empty: the label does
    Norm norm = Norm::none;       ///< determines the dashes, see dashes_of()
    int marker = 0;               ///< index of the marker, modulo line_markers

    bool operator==(const LineStyle&) const = default;
};

inline constexpr int line_markers = 4; ///< disc, square, triangle, diamond

/// Returns the alternating lengths of dashes and gaps, in line widths. Empty: a solid line, for `weighted`, for
/// raw samples of methods without gradients, and without a method.
std::span<const float> dashes_of(const LineStyle& look);

/// Draws a dashed line through the points in the current window, or a solid line if `dashes` is empty.
void draw_dashed(std::span<const ImVec2> points, std::span<const float> dashes, ImU32 colour, float width);

/// Draws a marker in the current window.
void draw_marker(ImVec2 at, int marker, float radius, ImU32 colour);

} // namespace tessera
