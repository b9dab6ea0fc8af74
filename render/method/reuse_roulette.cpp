#include "render/method/reuse_roulette.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// Of the luminance of what the paths share.
float standard_deviation(const PathReuse& reuse, std::span<const BasePath* const> set) {
    double sum = 0, squares = 0; // the squares of a float may be beyond floats
    for (const BasePath* path : set) {
        const double l = luminance(reuse.shared_light(*path));
        sum += l;
        squares += l * l;
    }
    const double count = static_cast<double>(set.size()), mean = sum / count;
    return static_cast<float>(std::sqrt(std::max(squares / count - mean * mean, 0.0)));
}

} // namespace

ReuseRoulette::ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                             std::span<const BasePath* const> set)
    : q_min_(settings.q_min) {
    switch (kind) {
    case RouletteKind::relative:
        threshold_ = settings.rr_scale * standard_deviation(reuse, set);
        break;
    case RouletteKind::absolute:
        threshold_ = settings.rr_delta;
        break;
    case RouletteKind::none:
        break;
    }
}

float ReuseRoulette::survival(Rgb light) const {
    const float l = luminance(light);
    return l < threshold_ ? std::max(l / threshold_, q_min_) : 1;
}

} // namespace tessera
