#pragma once

#include "recon/reconstruct.h"
#include "render/method/settings.h"
#include "render/path/counters.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace tessera {

/// How far a picture was from the reference after so much work.
struct ErrorPoint {
    int spp = 0;                                                      ///< samples a pixel
    double seconds = 0;                                               ///< wall time of the pane's passes
    double error = 0;                                                 ///< relMSE
    double standard_error = std::numeric_limits<double>::quiet_NaN(); ///< of it; not a number: not known
    std::size_t not_finite = 0; ///< pixels left out of it, as they or the reference's are not finite
};

/// How the shifts had ended after so much work.
struct ShiftPoint {
    int spp = 0;
    double seconds = 0;
    std::array<double, shift_outcome_count> shares{}; ///< of all shifts so far, [0, 1]
    Method method = Method::gpr;                      ///< that made them
};

/// The points of one render in the order of its passes: the newest always, older ones as far apart as a
/// logarithmic chart can show.
template <class Point>
class PassHistory {
public:
    void add(const Point& point) {
        const std::size_t n = points_.size();
        const bool replaces = n > 0 && point.spp <= points_.back().spp; // as does a reconstruction made anew
        const bool is_dense = n > 1 && points_[n - 1].spp < least_step * points_[n - 2].spp;
        if (replaces || is_dense)
            points_.back() = point;
        else
            points_.push_back(point);
    }
    void clear() { points_.clear(); }
    const std::vector<Point>& points() const { return points_; }

private:
    static constexpr double least_step = 1.04; // in samples: some 60 points a decade
    std::vector<Point> points_;
};

/// The errors of a pane's pictures that were made in one way: a line of the chart.
struct ErrorCurve {
    Method method = Method::gpr;
    ReconstructionSettings reconstruction; ///< Norm::none where the method has no gradients
    PassHistory<ErrorPoint> history;

    const std::vector<ErrorPoint>& points() const { return history.points(); }
};

} // namespace tessera
