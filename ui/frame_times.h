#pragma once

#include <string>
#include <vector>

namespace tessera {

/// How long frames took, from the first reading of input to the picture handed over.
struct FrameTimes {
    std::string label;
    std::vector<double> seconds; ///< a frame

    /// The value that a share of the frames does not exceed. 0 without any.
    double quantile(double share) const;
    /// "frames dragging: 120, median 12.3 ms, 99th percentile 20.1 ms".
    std::string text() const;
};

} // namespace tessera
