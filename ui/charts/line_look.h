#pragma once

#include "recon/picture/reconstruct.h"
#include "render/settings/settings.h"

#include <optional>
#include <span>

#include <imgui.h>

namespace tessera {

/// How lines of a chart are told apart, on the screen and in files alike: the colour stands for the method, the
/// dashes for the norm, and the marker for whatever else differs.
struct LineLook {
    std::optional<Method> method; ///< whose colour it has; empty: it has one by its label
    Norm norm = Norm::none;       ///< of a method with gradients; otherwise it does not count
    int marker = 0;               ///< which of line_markers, in turn

    bool operator==(const LineLook&) const = default;
};

inline constexpr int line_markers = 4; ///< disc, square, triangle, diamond

/// Lengths of dashes and of the gaps between them in turn, in widths of the line; empty: it is solid, as the lines
/// of methods without gradients are, and of the norm that is usual.
std::span<const float> dashes_of(const LineLook& look);

/// Draws a line through the points in the current window, with its dashes.
void draw_dashed(std::span<const ImVec2> points, std::span<const float> dashes, ImU32 colour, float width);

/// Draws a marker in the current window.
void draw_marker(ImVec2 at, int marker, float radius, ImU32 colour);

} // namespace tessera
