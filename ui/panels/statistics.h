#pragma once

#include "render/session/snapshot.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// One number of a render's counters, ready to be shown.
struct Statistic {
    std::string id; ///< "rays.camera"
    std::string label;
    std::string value;           ///< may be empty where the share says all
    std::optional<double> share; ///< of the group's whole, in [0, 1]
    std::string help;
};

struct StatisticGroup {
    std::string title;
    std::vector<Statistic> statistics;
};

/// What the snapshot's counters say, in groups. What its method does not do, or what did not happen, has no group.
std::vector<StatisticGroup> statistics(const Snapshot& snapshot);

/// "9999", "12.3 k", "4.56 M", "7.89 G".
std::string count_text(std::uint64_t count);

} // namespace tessera
