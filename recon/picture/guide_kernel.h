#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/pixel_loops.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace tessera {

// Kernels that join pixels which look alike: the 13 of 5x5 pixels with |i| + |j| <= 2, a step apart [the a trous
// wavelets of Dammertz 2010], in which a pixel weighs its share of a cubic spline times about
//     exp(-sum of (differences of guides / widths)^2) .
// Two pixels weigh as much for each other as the other way round.

using Plane = Image<float>;

/// Planes of a size, with anything in them.
template <std::size_t count>
void make_planes(std::array<Plane, count>& planes, int width, int height) {
    for (Plane& plane : planes)
        plane = Plane(width, height, Unfilled());
}

/// Guides over the widths of what counts as alike. Empty planes: there are none, and all pixels look alike.
inline constexpr int guide_count = 8;
using GuidePlanes = std::array<Plane, guide_count>;

/// Of what pixel i shows; 1: there are no guides. Darker surfaces have hardly any light to tell of.
inline Rgb seen_albedo(const GuideImages& guides, std::size_t i) {
    constexpr float least = 0.02f;
    return guides.empty() ? Rgb(1) : glm::max(guides.albedo.data()[i], Rgb(least));
}

/// The light on what pixel i shows: radiance over albedo.
inline Rgb light_at(const RgbImage& radiance, const GuideImages& guides, std::size_t i) {
    return radiance.data()[i] / seen_albedo(guides, i);
}

/// How bright light is: the mean of its channels, >= 0. What is compared with it counts as brighter by `dark` of
/// the picture's mean: with a twentieth, light leaks into black frames.
inline float brightness_of(Rgb light) {
    return std::max((light.r + light.g + light.b) / 3, 0.0f);
}
inline constexpr float dark = 0.2f;

/// A pixel and another, i and j steps on; of a kernel's pixels but the middle one, half: the others are these from
/// their other end. (With all of 5x5: hardly better, in twice the time.)
struct KernelPair {
    int i, j;

    constexpr float share() const {
        constexpr float spline[] = {1 / 16.0f, 1 / 4.0f, 3 / 8.0f, 1 / 4.0f, 1 / 16.0f};
        return spline[i + 2] * spline[j + 2];
    }
};
inline constexpr std::array<KernelPair, 6> kernel_pairs = {{{1, 0}, {2, 0}, {0, 1}, {0, 2}, {1, 1}, {-1, 1}}};

/// How much the two pixels of each pair count for each other, at the first of them. What stands for a pair that
/// reaches beyond the picture does not matter.
using PairWeights = std::array<Plane, kernel_pairs.size()>;

/// Columns that are worked on at a time, so that all about them stays at hand.
inline constexpr int kernel_chunk = 128;

/// Values times weights, and weights, summed over the kernels around the pixels [begin, end) of a row.
template <std::size_t planes>
struct KernelSums {
    int begin, end;
    float values[planes][kernel_chunk] = {}, weights[kernel_chunk] = {};

    /// Adds what the pixels `shift` columns on in another row give; their weights stand `place` columns on.
    void add(const std::array<Plane, planes>& from, int row, int shift, const float* row_weights, int place) {
        const int width = from[0].width(), first = std::max(begin, -shift),
                  count = std::min(end, width - shift) - first;
        if (count <= 0)
            return;
        const float* w = row_weights + first + place;
        for (std::size_t c = 0; c < planes; ++c) {
            const float* value = from[c].row(row) + first + shift;
            float* sum = values[c] + first - begin;
            for (int k = 0; k < count; ++k)
                sum[k] += w[k] * value[k];
        }
        float* sum = weights + first - begin;
        for (int k = 0; k < count; ++k)
            sum[k] += w[k];
    }
};

/// Calls visit(y, sums) for all pixels, some of a row at a time.
template <std::size_t planes, class Visit>
void for_kernel_sums(const std::array<Plane, planes>& from, const PairWeights& weights, int step,
                     const ParallelFor& parallel_for, Visit&& visit) {
    const int width = from[0].width(), height = from[0].height();
    const std::vector<float> own(static_cast<std::size_t>(width), KernelPair{0, 0}.share());
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; x += kernel_chunk) {
            KernelSums<planes> sums{x, std::min(width, x + kernel_chunk)};
            sums.add(from, y, 0, own.data(), 0);
            for (std::size_t k = 0; k < weights.size(); ++k) {
                const int shift = kernel_pairs[k].i * step;
                const int above = y - kernel_pairs[k].j * step, below = y + kernel_pairs[k].j * step;
                if (below < height)
                    sums.add(from, below, shift, weights[k].row(y), 0);
                if (above >= 0)
                    sums.add(from, above, -shift, weights[k].row(above), -shift);
            }
            visit(y, sums);
        }
    });
}

/// The means over the kernels around all pixels, by their weights.
/// @param means  of the same size, anything
template <std::size_t planes>
void write_kernel_means(const std::array<Plane, planes>& from, const PairWeights& weights, int step,
                        const ParallelFor& parallel_for, std::array<Plane, planes>& means) {
    for_kernel_sums(from, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < planes; ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                means[c](x, y) = sums.values[c][x - sums.begin] / sums.weights[x - sums.begin];
    });
}

/// Kernels that join pixels which look alike, however far apart: with five steps, each three times as wide as the
/// last, they reach 240 pixels, and leave none out.
class AlikePixels {
public:
    static constexpr std::array steps = {1, 3, 9, 27, 81};

    /// Empty guides: all pixels look alike.
    AlikePixels(glm::ivec2 size, const GuideImages& guides, const ParallelFor& parallel_for);

    const GuidePlanes& guides() const { return guides_; }

    /// Of the pairs steps[level] apart.
    const PairWeights& weights(std::size_t level) const { return weights_[level]; }

    /// Puts the mean over those of the first levels around each pixel in its place.
    void take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const;

    static constexpr std::size_t bytes_a_pixel =
        (steps.size() * kernel_pairs.size() + guide_count) * sizeof(float);

private:
    GuidePlanes guides_;
    std::array<PairWeights, steps.size()> weights_;
};

/// The weights of pairs whose brightness tells, too, and is noisy: those by guides times about exp(-u), where u is
/// how unlike the brightness is, half by the two pixels alone, half by all pairs in the same direction from a
/// square about as wide as the kernel, as patches tell in non-local means [Buades 2005]. Of noise a few pixels
/// have much, and look unlike by it alone; and a pattern that noise hides between two pixels is seen in a square.
/// (A straight edge is rather diluted there.)
/// @param by_guides   of pairs `step` apart
/// @param brightness  its logarithm
/// @param noise       the variance of its noise
/// @param scratch     of the picture's size, anything
/// @param weights     likewise
void write_noisy_weights(const PairWeights& by_guides, const Plane& brightness, const Plane& noise, int step,
                         const ParallelFor& parallel_for, Plane& scratch, PairWeights& weights);

} // namespace tessera
