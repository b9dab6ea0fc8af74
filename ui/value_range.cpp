#include "ui/value_range.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {
constexpr float decades_a_length = 2; // a drag over the legend multiplies by a hundred
constexpr float least_ratio = 1.01f;  // of the ends
constexpr float least = 1e-12f, most = 1e12f;
} // namespace

float ValueRange::share(float value) const {
    if (!logarithmic)
        return (value - low) / (high - low);
    return value > 0 ? std::log(value / low) / std::log(high / low) : -1;
}

float ValueRange::value(float share) const {
    return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

ValueRange ValueRange::with_low_dragged(float by) const {
    ValueRange range = *this;
    if (logarithmic)
        range.low = std::clamp(low * std::pow(10.0f, decades_a_length * by), least, high / least_ratio);
    else
        range.low = std::clamp(low + by * (high - low), 0.0f, high / least_ratio);
    return range;
}

ValueRange ValueRange::with_high_dragged(float by) const {
    ValueRange range = *this;
    range.high =
        std::clamp(high * std::pow(10.0f, decades_a_length * by), std::max(low * least_ratio, least), most);
    return range;
}

} // namespace tessera
