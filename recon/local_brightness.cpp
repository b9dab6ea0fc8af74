#include "recon/local_brightness.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

namespace tessera {

Image<float> local_mean_brightness(Image<float> brightness, int radius, const ParallelFor& parallel_for) {
    constexpr float largest = 1e20f, smallest = 1e-20f; // quotients and their squares stay finite
    const int width = brightness.width(), height = brightness.height();
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        float& b = brightness.data()[i];
        b = b < largest ? b : largest; // also replaces NaN
    });
    Image<float> rows(width, height, Unfilled());
    for (int round = 0; round < 2; ++round)
        take_wide_means(brightness, radius, rows, parallel_for);
    for_pixels(width, height, parallel_for,
               [&](std::size_t i) { brightness.data()[i] = std::max(brightness.data()[i], smallest); });
    return brightness;
}

} // namespace tessera
