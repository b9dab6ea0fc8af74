#include "ui/frame_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tessera {

double FrameTimes::quantile(double share) const {
    if (seconds.empty())
        return 0;
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const double place = std::ceil(share * static_cast<double>(sorted.size())) - 1;
    return sorted[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(sorted.size() - 1)))];
}

std::string FrameTimes::text() const {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%zu, median %.1f ms, 99th percentile %.1f ms", seconds.size(),
                  quantile(0.5) * 1e3, quantile(0.99) * 1e3);
    return "frames " + label + ": " + numbers;
}

} // namespace tessera
