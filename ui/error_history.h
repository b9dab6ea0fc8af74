#pragma once

#include <vector>

namespace tessera {

/// How far a picture was from the reference after so much work.
struct ErrorPoint {
    int spp = 0;        ///< samples a pixel
    double seconds = 0; ///< wall time of the pane's passes
    double error = 0;   ///< relMSE

    bool operator==(const ErrorPoint&) const = default;
};

/// The points of one render in the order of its passes: the newest always, older ones as far apart as a
/// logarithmic chart can show.
class ErrorHistory {
public:
    void add(const ErrorPoint& point);
    void clear() { points_.clear(); }
    const std::vector<ErrorPoint>& points() const { return points_; }

private:
    std::vector<ErrorPoint> points_;
};

/// The slope of the error in a log-log chart over the last decade of `x`: -1 is an error that falls as 1/x, as
/// noise does. 0 while there are fewer than three points.
double log_slope(const std::vector<ErrorPoint>& points, double (*x)(const ErrorPoint&));

} // namespace tessera
