#include "render/scene/alias_table.h"

#include <numeric>

namespace tessera {

AliasTable::AliasTable(const std::vector<double>& weights) : entries_(weights.size()) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> share(weights.size()); // of one slot: their mean is 1
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        const double probability = total > 0 ? weights[i] / total : 0;
        share[i] = probability * static_cast<double>(weights.size());
        entries_[i] = {1, i, static_cast<float>(probability)};
        (share[i] < 1 ? small : large).push_back(i);
    }
    // A slot whose share is small gives the rest of its place to one whose share is large. What is left over at
    // the end has a share of 1, but for rounding.
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back(), l = large.back();
        small.pop_back();
        entries_[s].threshold = static_cast<float>(share[s]);
        entries_[s].alias = l;
        share[l] -= 1 - share[s];
        if (share[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
}

} // namespace tessera
