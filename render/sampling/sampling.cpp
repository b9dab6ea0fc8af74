#include "render/sampling/sampling.h"

#include <cmath>
#include <numeric>

namespace tessera {

AliasTable::AliasTable(const std::vector<double>& weights) : entries_(weights.size()) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> share(weights.size()); // of one slot: their mean is 1
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        share[i] = total > 0 ? weights[i] / total * static_cast<double>(weights.size()) : 0;
        entries_[i] = {1, i, 0};
        (share[i] < 1 ? small : large).push_back(i);
    }
    // A slot whose share is small gives the rest of its place to one whose share is large. What is left over at
    // the end has a share of 1, but for rounding. Random numbers have 24 bits: finer thresholds would not be kept.
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back(), l = large.back();
        small.pop_back();
        const double threshold = std::ceil(share[s] * 0x1p24) * 0x1p-24;
        entries_[s].threshold = static_cast<float>(threshold);
        entries_[s].alias = l;
        share[l] -= 1 - threshold;
        if (share[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // The probabilities that the table has, after this rounding.
    std::vector<double> kept(weights.size(), 0.0);
    for (const Entry& entry : entries_) {
        kept[static_cast<std::size_t>(&entry - entries_.data())] += entry.threshold;
        kept[entry.alias] += 1 - entry.threshold;
    }
    for (std::size_t i = 0; i < entries_.size(); ++i)
        entries_[i].probability =
            total > 0 ? static_cast<float>(kept[i] / static_cast<double>(entries_.size())) : 0;
}

} // namespace tessera
