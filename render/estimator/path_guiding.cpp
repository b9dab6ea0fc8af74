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
    std::array<unsigned, bins> small, large;
    std::size_t smalls = 0, larges = 0;
    for (unsigned b = 0; b < bins; ++b)
        (left[b] < units_a_slot ? small[smalls++] : large[larges++]) = b;
    while (smalls > 0 && larges > 0) {
        const unsigned s = small[--smalls], l = large[larges - 1];
        slots_[s].threshold = static_cast<std::uint8_t>(left[s]);
        slots_[s].alias = static_cast<std::uint8_t>(l);
        left[l] -= units_a_slot - left[s];
        if (left[l] < units_a_slot) {
            --larges;
            small[smalls++] = l;
        }
    }
}

TriedShares squares_by_share(float value, float pdf_w, float guided, float used) {
    const float own = std::max(pdf_w - used * guided, 0.0f) / (1 - used); // of the BSDF
    TriedShares squares;
    for (std::size_t i = 0; i < squares.size(); ++i)
        squares[i] = value * value * (pdf_w / ((1 - tried_shares[i]) * own + tried_shares[i] * guided));
    return squares;
}

} // namespace tessera
