#pragma once

#include "render/settings/settings.h"

#include <span>

namespace tessera {

struct BasePath;
class PathReuse;

/// Result of Russian roulette on the reuse of one base path.
struct ReuseDecision {
    float survival = 0; ///< q, the probability of reuse; 0: the path has no light to reuse
    float scale = 0;    ///< its weight 1/q; 0: the path is not reused

    bool is_dark() const { return survival <= 0; }
    bool survives() const { return scale > 0; }
};

/// Russian roulette on reuse: decides which base paths of one sampling set are shifted to all its pixels. A path
/// whose light has luminance L is reused with probability
///   q = clamp(L / threshold, q_min, 1).
/// Absolute: L is the radiance toward the camera, and the threshold is rr_delta [Bauszat 2017, 3.3]. Relative: L
/// is the arriving luminance (PathReuse::arriving_luminance). A path that begins on a dark texel is as useful to
/// bright texels as any other path; its own small radiance would end it too often, with a large weight 1/q. The
/// threshold is one standard deviation of L over the set, the noise that hides a lost path (docs/decisions.md).
/// The relative roulette does not depend on the unit of radiance. An evenly lit set keeps all its paths; a set
/// with few bright paths spends its time on them. q depends only on base paths of the same pass, and survivors
/// weigh 1/q, so the estimate stays unbiased.
class ReuseRoulette {
public:
    /// Least probability of reuse for a path with light [Bauszat 2017]. It is positive, because a path can
    /// contribute far more to a neighbour than to its own pixel.
    static constexpr float q_min = 0.1f;

    /// @param settings  has rr_delta; `kind` replaces its own kind
    ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                  std::span<const BasePath* const> set);

    /// Returns the probability that a path with light is reused.
    float survival(const BasePath& path) const;

private:
    const PathReuse& reuse_;
    RouletteKind kind_;
    float threshold_ = 0; ///< luminance
};

} // namespace tessera
