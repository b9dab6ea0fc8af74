#include "ui/tone.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

float srgb(float c) {
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

/// ACES' reference transform, fitted by a fraction [Narkowicz 2015].
float filmic(float c) {
    return std::clamp(c * (2.51f * c + 0.03f) / (c * (2.43f * c + 0.59f) + 0.14f), 0.0f, 1.0f);
}

} // namespace

Rgb displayed(const Rgb& radiance, const Tone& tone) {
    Rgb result;
    for (int i = 0; i < 3; ++i) {
        const float c = std::clamp(radiance[i] * std::exp2(tone.exposure), 0.0f, 1e4f);
        const float unit = std::min(c, 1.0f);
        result[i] = tone.curve == Tone::Curve::filmic  ? srgb(filmic(c))
                    : tone.curve == Tone::Curve::gamma ? std::pow(unit, 1 / tone.gamma)
                                                       : srgb(unit);
    }
    return result;
}

} // namespace tessera
