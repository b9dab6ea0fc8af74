#pragma once

#include "render/method/settings.h"
#include "render/path/path_reuse.h"

#include <span>

namespace tessera {

/// What the roulette decided on one base path.
struct ReuseDecision {
    float survival = 0; ///< q, the probability that it is reused; 0: it is dark, there is nothing to reuse
    float scale = 0;    ///< 1/q, what it weighs; 0: it is not reused

    bool is_dark() const { return survival <= 0; }
    bool survives() const { return scale > 0; }
};

/// The roulette that decides which base paths of one sampling set are shifted to all its pixels. A path whose
/// light has luminance L is reused with probability
///   q = clamp(L / threshold, q_min, 1).
/// Absolute: the threshold is a radiance, rr_delta [Bauszat 2017, 3.3]. Relative: it is rr_scale standard
/// deviations of the set's own L, the noise that a lost path would drown in. Then the unit of light does not
/// matter, a set that is lit evenly keeps all its paths, and one in which few paths carry light spends its time on
/// these. As q stands on nothing but the base paths at hand, and survivors weigh 1/q, the estimate stays unbiased.
class ReuseRoulette {
public:
    /// @param settings  has the thresholds; its own kind is not looked at
    ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                  std::span<const BasePath* const> set);

    /// Probability that a path with this light (PathReuse::shared_light) is reused.
    float survival(Rgb light) const;

private:
    float threshold_ = 0; // luminance
    float q_min_;
};

} // namespace tessera
