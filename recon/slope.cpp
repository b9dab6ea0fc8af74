#include "recon/slope.h"

#include <cmath>
#include <limits>

namespace tessera {

double log_log_slope(std::span<const glm::dvec2> points) {
    double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
    for (const glm::dvec2& p : points) {
        const double x = std::log(p.x), y = std::log(p.y);
        if (!std::isfinite(x) || !std::isfinite(y))
            continue;
        n += 1;
        x_sum += x;
        y_sum += y;
        xx_sum += x * x;
        xy_sum += x * y;
    }
    const double spread = n * xx_sum - x_sum * x_sum;
    return spread > 1e-9 * n * xx_sum ? (n * xy_sum - x_sum * y_sum) / spread
                                      : std::numeric_limits<double>::quiet_NaN();
}

} // namespace tessera
