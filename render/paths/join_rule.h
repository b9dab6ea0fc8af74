#pragma once

#include "render/settings/settings.h"

#include <algorithm>

namespace tessera {

/// Decides which edges shifts connect, theory (16) to (18). Base path and offset path each apply the rule to
/// their own edge. A shift fails where they disagree, because it would not be its own inverse.
///
/// A connection keeps x_{i+1}, while the offset vertex y_i is at a distance of about s_i from x_i. s_i (`apart`)
/// is the footprint of shift_distance pixels; it grows along the path as after flat mirrors [Suykens 2001]. Seen
/// from x_{i+1}, the edge of length d turns by s_i / d. At x_i the lobe turns as well, so edge and lobe turn
/// against each other by s_{i+1} / d = s_i / d + spread. Most offset paths would miss a narrower lobe; the shift
/// copies half vectors there.
class JoinRule {
public:
    /// @param pixel_angle  BasePath::pixel_angle
    JoinRule(const ShiftSettings& settings, float pixel_angle)
        : threshold_(settings.shift_threshold),
          pixels_(settings.shift == ShiftKind::reconnection ? 0 : settings.shift_distance),
          spread_(pixels_ * pixel_angle) {}

    /// Returns s_1, theory (16), in scene units. @param pixel_width  BasePath::pixel_width
    float apart(float pixel_width) const { return pixels_ * pixel_width; }
    /// Returns s_{i+1}, theory (16). @param before  s_i
    float apart(float before, float distance) const { return before + spread_ * distance; }

    /// Returns s_{i+1} / d, the angle in radians by which x_i's lobe turns against the edge. The distance may be
    /// infinite.
    float turn(float apart, float distance) const { return apart / distance + spread_; }

    /// Returns whether a lobe is wide enough for the turn, theory (17). The limit of 1 radian lets wide lobes
    /// connect edges of any length.
    bool covers(float roughness, float turn) const {
        return roughness > threshold_ && roughness >= roughness_a_turn * std::min(turn, 1.0f);
    }
    /// Returns whether covers() holds for all turns.
    bool covers_all(float roughness) const { return roughness > threshold_ && roughness >= roughness_a_turn; }
    /// Returns whether covers() holds for no turn; the smallest one is spread_.
    bool covers_none(float roughness) const { return !covers(roughness, spread_); }

    /// Returns whether light from beyond x_{i+1} can use the connection, theory (18). Close surfaces, as in a
    /// corner, look very different from y_i than from x_i, so the edge must have the length s_i. The lobe of
    /// x_{i+1} must cover the turn at its end.
    /// @param roughness  of x_{i+1}
    bool reaches_beyond(float roughness, float apart, float distance) const {
        return distance >= apart && covers(roughness, apart / distance);
    }

private:
    /// Angle of a lobe of roughness 1, with a part of its tail, in radians (docs/decisions.md).
    static constexpr float lobe_of_roughness = 8;
    static constexpr float roughness_a_turn = 1 / lobe_of_roughness;

    float threshold_;
    float pixels_; ///< distance of pixels that reuse each other's paths, in pixels
    float spread_; ///< the same distance as an angle, radians
};

} // namespace tessera
