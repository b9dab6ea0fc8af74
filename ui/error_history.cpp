#include "ui/error_history.h"

#include <cmath>

namespace tessera {

namespace {
constexpr double least_step = 1.04; // in samples: some 60 points a decade
}

void ErrorHistory::add(const ErrorPoint& point) {
    const std::size_t n = points_.size();
    if (n > 0 && point.spp <= points_.back().spp) // of a reconstruction with other settings
        points_.back() = point;
    else if (n > 1 && points_[n - 1].spp < least_step * points_[n - 2].spp)
        points_.back() = point;
    else
        points_.push_back(point);
}

double log_slope(const std::vector<ErrorPoint>& points, double (*x)(const ErrorPoint&)) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0; // least squares
    for (const ErrorPoint& p : points) {
        if (!(x(p) > 0) || !(p.error > 0) || x(p) < 0.1 * x(points.back()))
            continue;
        const double a = std::log(x(p)), b = std::log(p.error);
        n += 1;
        sx += a;
        sy += b;
        sxx += a * a;
        sxy += a * b;
    }
    const double spread = n * sxx - sx * sx;
    return n >= 3 && spread > 0 ? (n * sxy - sx * sy) / spread : 0;
}

} // namespace tessera
