#include "render/reuse_maps.h"

#include <algorithm>
#include <numeric>

namespace tessera {

namespace {

/// Of 0: 0.
float share_of(std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(std::max(whole, 1u));
}

template <class NumberOf>
Image<float> map_of(const Image<ReuseCounts>& counts, NumberOf number_of) {
    Image<float> map(counts.width(), counts.height());
    std::transform(counts.begin(), counts.end(), map.begin(), number_of);
    return map;
}

} // namespace

std::uint32_t ReuseCounts::tried() const {
    return std::accumulate(shifts.begin(), shifts.end(), std::uint32_t{0});
}

void ReuseCounts::operator+=(const ReuseCounts& other) {
    for (std::size_t i = 0; i < shifts.size(); ++i)
        shifts[i] += other.shifts[i];
    reused += other.reused;
    skipped += other.skipped;
}

Image<float> ReuseMaps::reused() const {
    const auto n = static_cast<float>(std::max(passes, 1));
    return map_of(counts, [n](const ReuseCounts& c) { return static_cast<float>(c.arrived()) / n; });
}

Image<float> ReuseMaps::share(ShiftOutcome outcome) const {
    const auto i = static_cast<std::size_t>(outcome);
    return map_of(counts, [i](const ReuseCounts& c) { return share_of(c.shifts[i], c.tried()); });
}

Image<float> ReuseMaps::failed() const {
    return map_of(counts, [](const ReuseCounts& c) { return share_of(c.failed(), c.tried()); });
}

Image<float> ReuseMaps::survival() const {
    return map_of(counts, [](const ReuseCounts& c) { return share_of(c.reused, c.reused + c.skipped); });
}

} // namespace tessera
