#include "ui/gl/tone.h"

#include "render/io/plain_images.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {
constexpr float decades_a_length = 2; // a drag over the whole legend multiplies by 100
constexpr float least_ratio = 1.01f;  // of high to low
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

namespace {

/// Rational fit of the ACES reference transform [Narkowicz 2015].
float filmic(float c) {
    return std::clamp(c * (2.51f * c + 0.03f) / (c * (2.43f * c + 0.59f) + 0.14f), 0.0f, 1.0f);
}

} // namespace

Rgb displayed(const Rgb& radiance, const Tone& tone) {
    Rgb result;
    for (int i = 0; i < 3; ++i) {
        const float c = std::clamp(radiance[i] * std::exp2(tone.exposure), 0.0f, 1e4f);
        result[i] = linear_to_srgb(tone.curve == Tone::Curve::filmic ? filmic(c) : std::min(c, 1.0f));
    }
    return result;
}

} // namespace tessera
