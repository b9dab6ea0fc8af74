#include "render/estimator/path_guiding.h"

namespace tessera {

DirectionMap::DirectionMap(const Shares& shares) {
    // Whole units that add up to all there are: differences of rounded sums.
    std::array<unsigned, bins> left;
    double sum = 0;
    unsigned before = 0;
    for (unsigned b = 0; b < bins; ++b) {
        sum += static_cast<double>(shares[b]);
        const double rounded = std::floor(sum * units + 0.5);
        const unsigned now = b + 1 == bins ? units : static_cast<unsigned>(std::clamp(rounded, 0.0, 1.0 * units));
        left[b] = now - before;
        before = now;
    }
    // No bin has all, as then its number of units would not fit: its neighbour has one.
    for (unsigned b = 0; b < bins; ++b)
        if (left[b] == units)
            --left[b], ++left[(b + 1) % bins];
    for (unsigned b = 0; b < bins; ++b)
        slots_[b] = {units_a_slot - 1, static_cast<std::uint8_t>(b), static_cast<std::uint16_t>(left[b])};
    // As in AliasTable, but in whole units.
    std::vector<unsigned> small, large;
    for (unsigned b = 0; b < bins; ++b)
        (left[b] < units_a_slot ? small : large).push_back(b);
    while (!small.empty() && !large.empty()) {
        const unsigned s = small.back(), l = large.back();
        small.pop_back();
        slots_[s].threshold = static_cast<std::uint8_t>(left[s]);
        slots_[s].alias = static_cast<std::uint8_t>(l);
        left[l] -= units_a_slot - left[s];
        if (left[l] < units_a_slot) {
            large.pop_back();
            small.push_back(l);
        }
    }
}

} // namespace tessera
