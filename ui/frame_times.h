#pragma once

#include <string>
#include <vector>

namespace tessera {

/// How long frames took, from the first reading of input to the picture handed over.
struct FrameTimes {
    std::string label;
    std::vector<double> seconds; ///< a frame
    double period = 0;           ///< seconds of all of them, with what lay between
    std::vector<double> behind;  ///< seconds from a camera to the first picture of it; empty: it did not move

    /// "frames dragging: 120, median 12.3 ms, 99th percentile 20.1 ms", and where the camera moved "; 40 pictures,
    /// 11.2 a second, behind the camera by a median of 70.1 ms".
    std::string text() const;
};

/// The value that a share of the values does not exceed. 0 without any.
double quantile(std::vector<double> values, double share);

} // namespace tessera
