#include "render/estimator/sampling_set.h"

#include "render/estimator/pass.h"

namespace tessera {

void SamplingSet::assign(PixelRect rect) {
    clear();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            add(x, y);
}

void SamplingSet::collect(const BaseBlock& base) {
    paths.clear();
    for (glm::ivec2 p : pixels)
        paths.push_back(&base.at(p.x, p.y));
    radiance.assign(pixels.size(), Rgb(0));
    reuse.assign(pixels.size(), {});
}

void SamplingSet::count(std::span<const ShiftOutcome> outcomes, int k) {
    for (std::size_t m = 0; m < outcomes.size(); ++m)
        if (m != static_cast<std::size_t>(k))
            ++reuse[m].shifts[static_cast<std::size_t>(outcomes[m])];
}

void SamplingSet::count(const ReuseDecision& decision, int k) {
    ReuseCounts& counts = reuse[static_cast<std::size_t>(k)];
    if (!decision.is_dark())
        ++(decision.survives() ? counts.reused : counts.skipped);
}

PixelSample SamplingSet::sample(int i, const PathReuse& estimator) const {
    const auto m = static_cast<std::size_t>(i);
    const BasePath& path = *paths[m];
    return {radiance[m], Rgb(0), Rgb(0), path.very_direct, reuse[m], estimator.shared_luminance(path)};
}

} // namespace tessera
