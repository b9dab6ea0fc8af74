#include "render/estimator/reuse_roulette.h"

#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// Returns the standard deviation of the arriving luminance over the paths of a set.
float standard_deviation(const PathReuse& reuse, std::span<const BasePath* const> set) {
    double sum = 0, squares = 0; // the squares of a float may be beyond floats
    for (const BasePath* path : set) {
        const double l = std::max(reuse.arriving_luminance(*path), 0.0f);
        sum += l;
        squares += l * l;
    }
    const double count = static_cast<double>(set.size()), mean = sum / count;
    return static_cast<float>(std::sqrt(std::max(squares / count - mean * mean, 0.0)));
}

} // namespace

ReuseRoulette::ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                             std::span<const BasePath* const> set)
    : reuse_(reuse), kind_(kind) {
    switch (kind) {
    case RouletteKind::relative:
        threshold_ = standard_deviation(reuse, set);
        break;
    case RouletteKind::absolute:
        threshold_ = settings.rr_delta;
        break;
    case RouletteKind::none:
        break;
    }
}

float ReuseRoulette::survival(const BasePath& path) const {
    const float l =
        kind_ == RouletteKind::absolute ? luminance(reuse_.shared_light(path)) : reuse_.arriving_luminance(path);
    return l < threshold_ ? std::max(l / threshold_, q_min) : 1;
}

} // namespace tessera
