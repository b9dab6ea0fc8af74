#include "ui/histogram.h"

#include <algorithm>
#include <cmath>

namespace tessera {

float Histogram::low_end(int bin) {
    return std::exp2(static_cast<float>(first_stop) + static_cast<float>(bin) / bins_a_stop);
}

Histogram histogram_of(const RgbImage& image) {
    Histogram h;
    for (const Rgb& pixel : image) {
        const float l = luminance(pixel);
        if (!is_finite(pixel)) {
            ++h.not_finite;
        } else if (l <= 0) {
            ++(l < 0 ? h.negative : h.black);
        } else {
            const float place = (std::log2(l) - Histogram::first_stop) * Histogram::bins_a_stop;
            const int bin = std::clamp(static_cast<int>(std::floor(place)), 0, Histogram::bin_count - 1);
            ++h.bins[static_cast<std::size_t>(bin)];
        }
    }
    return h;
}

} // namespace tessera
