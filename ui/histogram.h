#pragma once

#include "recon/image.h"

#include <array>
#include <cstddef>

namespace tessera {

/// How the luminances of an image are spread, on a logarithmic scale.
struct Histogram {
    static constexpr int first_stop = -12, last_stop = 8, bins_a_stop = 6; // log2 of radiance
    static constexpr int bin_count = (last_stop - first_stop) * bins_a_stop;

    std::array<std::size_t, bin_count> bins{}; ///< what is beyond the ends is in the first and the last
    std::size_t black = 0, negative = 0, not_finite = 0;

    /// The luminance with which a bin begins.
    static float low_end(int bin);
};

Histogram histogram_of(const RgbImage& image);

} // namespace tessera
