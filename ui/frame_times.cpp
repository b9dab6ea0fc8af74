#include "ui/frame_times.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace tessera {

double quantile(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const double place = std::ceil(share * static_cast<double>(values.size())) - 1;
    return values[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(values.size() - 1)))];
}

std::string FrameTimes::text() const {
    std::string line = fmt::format("frames {}: {}, median {:.1f} ms, 99th percentile {:.1f} ms", label,
                                   seconds.size(), quantile(seconds, 0.5) * 1e3, quantile(seconds, 0.99) * 1e3);
    if (!behind.empty())
        line +=
            fmt::format("; {} pictures, {:.1f} a second, behind the camera by a median of {:.1f} ms",
                        behind.size(), static_cast<double>(behind.size()) / period, quantile(behind, 0.5) * 1e3);
    return line;
}

} // namespace tessera
