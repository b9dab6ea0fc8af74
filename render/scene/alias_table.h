#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Chooses an index in proportion to its weight, in a time that does not depend on how many there are
/// [Walker 1974, Vose 1991].
class AliasTable {
public:
    AliasTable() = default;
    /// Weights are not negative; where all are 0, all probabilities are 0 and nothing may be chosen.
    explicit AliasTable(const std::vector<double>& weights);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    float probability(std::size_t i) const { return entries_[i].probability; }

    /// With random numbers in [0, 1)^2. One of its own for the threshold: of one float, many entries would leave
    /// few bits for it.
    std::size_t choose(glm::vec2 u) const {
        const auto slot = static_cast<std::size_t>(u.x * static_cast<float>(entries_.size()));
        const std::size_t first = slot < entries_.size() ? slot : entries_.size() - 1;
        return u.y < entries_[first].threshold ? first : entries_[first].alias;
    }

private:
    struct Entry {
        float threshold; // below it this entry, else `alias`
        std::uint32_t alias;
        float probability;
    };
    std::vector<Entry> entries_;
};

} // namespace tessera
