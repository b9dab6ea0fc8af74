#include "ui/tone.h"

#include "render/load/png.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

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
        result[i] = tone.curve == Tone::Curve::filmic  ? srgb_encoded(filmic(c))
                    : tone.curve == Tone::Curve::gamma ? std::pow(unit, 1 / tone.gamma)
                                                       : srgb_encoded(unit);
    }
    return result;
}

} // namespace tessera
