#include "recon/guided/shrinkage.h"

#include "recon/square_means.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera {

namespace {

/// Writes |finer - coarser|^1/2 over brightness^1/2, of the picture and of its noise.
void write_root_sizes(const NoisyPlanes& finer, const NoisyPlanes& coarser, const Plane& dark,
                      const ParallelFor& parallel_for, Plane& sizes, Plane& noise) {
    const int width = sizes.width();
    parallel_for(sizes.height(), [&](int y) {
        for (int x = 0; x < width; x += kernel_chunk) {
            const int count = std::min(kernel_chunk, width - x);
            const std::size_t place = static_cast<std::size_t>(y) * width + x;
            float inverse_brightness[kernel_chunk], squares[2][kernel_chunk] = {};
            for (int i = 0; i < count; ++i)
                inverse_brightness[i] = 1 / brightness_at(coarser, dark.data()[place + i], place + i);
            for (std::size_t c = 0; c < finer.size(); ++c) {
                constexpr float largest = 1e18f; // its square stays finite
                const float *fine = finer[c].row(y) + x, *coarse = coarser[c].row(y) + x;
                float* sum = squares[c / 3];
                for (int i = 0; i < count; ++i) {
                    const float d = std::min(std::abs(fine[i] - coarse[i]) * inverse_brightness[i], largest);
                    sum[i] += d * d;
                }
            }
            float *size = sizes.row(y) + x, *noise_size = noise.row(y) + x;
            for (int i = 0; i < count; ++i) {
                size[i] = std::sqrt(std::sqrt(squares[0][i]));
                noise_size[i] = std::sqrt(std::sqrt(squares[1][i]));
            }
        }
    });
}

} // namespace

void write_trust(const NoisyPlanes& finer, const NoisyPlanes& coarser, const Plane& dark, int radius,
                 const ParallelFor& parallel_for, ShrinkageScratch& scratch, Plane& trust) {
    write_root_sizes(finer, coarser, dark, parallel_for, scratch.sizes, scratch.noise);
    take_wide_means(scratch.sizes, radius, scratch.rows, parallel_for);
    take_wide_means(scratch.noise, radius, scratch.rows, parallel_for);
    for_pixels(trust.width(), trust.height(), parallel_for, [&](std::size_t i) {
        const float size = scratch.sizes.data()[i];
        const float ratio = size > 0 ? scratch.noise.data()[i] / size : 1;
        trust.data()[i] = std::max(1 - ratio * ratio * ratio * ratio, 0.0f);
    });
}

} // namespace tessera
