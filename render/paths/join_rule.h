#pragma once

#include "render/settings/settings.h"

#include <algorithm>

namespace tessera {

/// When offsets may be joined to a base path, as seen from one of the two ways. Base and offset are asked alike,
/// and must agree, or a shift would not be its own inverse.
///
/// While a join holds x_{i+1}, the offset's y_i lies elsewhere on the tile: `apart` is how far, the footprint of
/// so many pixels, which grows along the path as they would part at mirrors. Seen from x_{i+1} the edge turns by
/// apart / d. At x_i the lobe turns, too, as the direction from which it is seen does: what a mirror there would
/// show at x_{i+1} moves by the footprint at that end, and so the turn is (apart + spread d) / d. Lobes narrower
/// than that are missed by nearly all offsets, whose half vectors are copied instead.
class JoinRule {
public:
    /// @param pixel_angle  BasePath::pixel_angle
    JoinRule(const ShiftSettings& settings, float pixel_angle)
        : threshold_(settings.shift_threshold),
          pixels_(settings.shift == ShiftKind::reconnection ? 0 : settings.shift_distance),
          spread_(pixels_ * pixel_angle) {}

    /// Of vertices x_1. @param pixel_width  BasePath::pixel_width
    float apart(float pixel_width) const { return pixels_ * pixel_width; }
    /// At the end of an edge, by how far apart they were at its beginning.
    float apart(float before, float distance) const { return before + spread_ * distance; }

    /// How far x_i's lobe is turned against the edge, in radians; the distance may be infinite.
    float turn(float apart, float distance) const { return apart / distance + spread_; }

    /// Whether a lobe is wide enough for that turn. Light that x_{i+1} itself gives is joined to at any length:
    /// one that is not narrow turns far with it.
    bool covers(float roughness, float turn) const {
        return roughness > threshold_ && roughness >= roughness_a_turn * std::min(turn, 1.0f);
    }
    bool covers_all(float roughness) const { return roughness > threshold_ && roughness >= roughness_a_turn; }
    bool covers_none(float roughness) const { return !covers(roughness, spread_); }

    /// Whether light from beyond x_{i+1} is, by that end of the edge: what a vertex sees close by, as in a corner,
    /// looks quite different from another pixel's vertex, and what x_{i+1} reflects must reach it. The light would
    /// stay with the base.
    /// @param roughness  of x_{i+1}
    bool reaches_beyond(float roughness, float apart, float distance) const {
        return distance >= apart && covers(roughness, apart / distance);
    }

private:
    /// Angle of a lobe, in radians, for a roughness of 1; it includes a part of the tail. 8 and 16 have the same
    /// error, 2 and 4 a larger one on glossy surfaces (TRIALS.md, "Which edges are joined").
    static constexpr float lobe_of_roughness = 8;
    static constexpr float roughness_a_turn = 1 / lobe_of_roughness;

    float threshold_;
    float pixels_; ///< across which paths are shared
    float spread_; ///< the same, as an angle
};

} // namespace tessera
