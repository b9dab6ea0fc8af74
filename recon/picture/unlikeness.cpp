#include "recon/picture/unlikeness.h"

#include "recon/square_means.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tessera {

namespace {

// What counts as unlike where two pixels are compared, and where the squares around them are. Tried on Veach,
// Ajar, Country Kitchen, Bathroom and The Grey & White Room, 4 and about 15 samples: none matters by more than
// half a percent of FLIP when it is changed by a third.
constexpr float pixel_width = 16, square_width = 3;
constexpr float most_unlike = 32; // of a pair in a square: one pixel does not decide on all that are around

/// The pixels of a line that have another so many on, and how many of the squares around one of them have.
struct PairedPixels {
    int size, begin, end;

    PairedPixels(int all, int step)
        : size(all), begin(std::clamp(-step, 0, all)), end(std::clamp(all - step, begin, all)) {}

    /// What makes the mean over all pixels of the line within the radius one over those that are paired.
    float of_paired(int x, int radius) const {
        const int all = std::min(size, x + radius + 1) - std::max(0, x - radius);
        const int paired = std::min(end, x + radius + 1) - std::max(begin, x - radius);
        return static_cast<float>(all) / static_cast<float>(paired);
    }
};

/// Calls visit(x, unlike) for pixels of row y: by what their brightness differs from that of those a step on,
/// squared, in variances of its noise.
/// @param brightness, noise  logarithm, and the variance of its noise
template <class Visit>
void for_unlikeness(const Plane& brightness, const Plane& noise, int y, KernelPair step, PairedPixels columns,
                    const Visit& visit) {
    if (columns.begin == columns.end)
        return;
    const float *own = brightness.row(y), *other = brightness.row(y + step.j) + step.i;
    const float *own_noise = noise.row(y), *other_noise = noise.row(y + step.j) + step.i;
    for (int x = columns.begin; x < columns.end; ++x) {
        const float d = own[x] - other[x];
        visit(x, d * d / (own_noise[x] + other_noise[x] + 1e-7f));
    }
}

} // namespace

void write_unlikeness(const Plane& brightness, const Plane& noise, int step, const ParallelFor& parallel_for,
                      Plane& scratch, PairWeights& unlike) {
    const int width = noise.width(), height = noise.height(), radius = 2 * step;
    for (std::size_t k = 0; k < kernel_pairs.size(); ++k) {
        const KernelPair apart{kernel_pairs[k].i * step, kernel_pairs[k].j * step};
        const PairedPixels columns(width, apart.i), rows(height, apart.j);
        Plane& pairs = unlike[k];
        parallel_for(height, [&](int y) {
            float* row = pairs.row(y);
            std::fill_n(row, width, 0.0f);
            if (y < rows.end)
                for_unlikeness(brightness, noise, y, apart, columns,
                               [=](int x, float own) { row[x] = std::min(own, most_unlike); });
        });
        take_wide_means(pairs, radius, scratch, parallel_for);
        std::vector<float> shares(static_cast<std::size_t>(width));
        for (int x = columns.begin; x < columns.end; ++x)
            shares[static_cast<std::size_t>(x)] = columns.of_paired(x, radius) / square_width;
        parallel_for(rows.end, [&](int y) {
            float* row = pairs.row(y);
            const float share = rows.of_paired(y, radius);
            for_unlikeness(brightness, noise, y, apart, columns, [&, row](int x, float own) {
                row[x] = 0.5f * (own / pixel_width + share * shares[static_cast<std::size_t>(x)] * row[x]);
            });
        });
    }
}

} // namespace tessera
