// Weighted sums over the pixels of small kernels, whose pixels may be far apart.
#pragma once

#include "recon/image.h"
#include "recon/lanes.h"
#include "recon/parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tessera {

using Plane = Image<float>;

/// Planes of a size, with anything in them.
template <std::size_t count>
void make_planes(std::array<Plane, count>& planes, int width, int height) {
    for (Plane& plane : planes)
        plane = Plane(width, height, Unfilled());
}

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
// The first of these, of a row or a column. Smoothing has no more: with all, no less error.
inline constexpr std::size_t straight_pairs = 4;

/// How much the two pixels of each pair, or of the first pairs, count for each other, at the first of the two.
/// What stands for a pair that reaches beyond the picture does not matter.
using PairWeights = std::array<Plane, kernel_pairs.size()>;
using StraightWeights = std::array<Plane, straight_pairs>;

/// Columns that are worked on at a time, so that all about them stays at hand.
inline constexpr int kernel_chunk = 256;

/// Pixels that the kernels of a row take: those `shift` columns on in a row, whose weights stand `place` columns
/// on in another.
struct KernelTap {
    const float* weights;
    int row, shift, place;
};

/// The taps of a row, of which there is one at least: those in rows beyond the picture are left out.
class KernelTaps {
public:
    /// @param own  of the row's own pixels, the weights
    KernelTaps(std::span<const Plane> weights, int step, int y, const float* own) {
        taps_[0] = {own, y, 0, 0};
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const int shift = kernel_pairs[k].i * step;
            const int above = y - kernel_pairs[k].j * step, below = y + kernel_pairs[k].j * step;
            if (below < weights[k].height())
                taps_[count_++] = {weights[k].row(y), below, shift, 0};
            if (above >= 0)
                taps_[count_++] = {weights[k].row(above), above, -shift, -shift};
        }
    }

    const KernelTap* begin() const { return taps_; }
    const KernelTap* end() const { return taps_ + count_; }

    static constexpr std::size_t most = 2 * kernel_pairs.size() + 1;

private:
    KernelTap taps_[most];
    int count_ = 1;
};

/// Values times weights, and weights, summed over the kernels around the pixels [begin, end) of a row.
template <std::size_t planes>
class KernelSums {
public:
    int begin, end;
    float values[planes][kernel_chunk], weights[kernel_chunk];

    /// Sums are made in registers, plane by plane, where all pixels have a tap, and taps beyond the row's ends
    /// follow for those that do. (A tap at a time for all planes, sums would be fetched and put back for each: 1.1
    /// to 1.5 times the time.)
    KernelSums(const std::array<Plane, planes>& from, const KernelTaps& taps, int x)
        : begin(x), end(std::min(x + kernel_chunk, from[0].width())) {
        const auto is_whole = [&](const KernelTap& tap) {
            return begin + tap.shift >= 0 && end + tap.shift <= from[0].width();
        };
        Term terms[KernelTaps::most];
        for (std::size_t c = 0; c <= planes; ++c) { // and last of ones
            int count = 0;
            for (const KernelTap& tap : taps)
                if (is_whole(tap))
                    terms[count++] = {tap.weights + (begin + tap.place),
                                      c < planes ? from[c].row(tap.row) + (begin + tap.shift) : nullptr};
            sum_up(terms, count, c < planes ? values[c] : weights);
        }
        for (const KernelTap& tap : taps)
            if (!is_whole(tap))
                add_part(from, tap);
    }

private:
    /// Weights and values, from pixel `begin` on.
    struct Term {
        const float *weights, *values; ///< null: ones
    };

    void sum_up(const Term* terms, int count, float* sums) const {
        constexpr int block = 2 * lanes;
        int i = 0;
        for (; i + block <= end - begin; i += block) {
            Lanes first{}, second{};
            for (const Term* term = terms; term != terms + count; ++term) {
                Lanes a = load(term->weights + i), b = load(term->weights + i + lanes);
                if (term->values) {
                    a *= load(term->values + i);
                    b *= load(term->values + i + lanes);
                }
                first += a;
                second += b;
            }
            store(sums + i, first);
            store(sums + i + lanes, second);
        }
        for (; i < end - begin; ++i) {
            sums[i] = 0;
            for (const Term* term = terms; term != terms + count; ++term)
                sums[i] += term->weights[i] * (term->values ? term->values[i] : 1);
        }
    }

    void add_part(const std::array<Plane, planes>& from, const KernelTap& tap) {
        const int first = std::max(begin, -tap.shift), last = std::min(end, from[0].width() - tap.shift);
        for (int x = first; x < last; ++x)
            weights[x - begin] += tap.weights[x + tap.place];
        for (std::size_t c = 0; c < planes; ++c) {
            const float* row = from[c].row(tap.row);
            for (int x = first; x < last; ++x)
                values[c][x - begin] += tap.weights[x + tap.place] * row[x + tap.shift];
        }
    }
};

/// Calls visit(y, sums) for all pixels, some of a row at a time.
template <std::size_t planes, class Visit>
void for_kernel_sums(const std::array<Plane, planes>& from, std::span<const Plane> weights, int step,
                     const ParallelFor& parallel_for, Visit&& visit) {
    const int width = from[0].width(), height = from[0].height();
    const std::vector<float> own(static_cast<std::size_t>(width), KernelPair{0, 0}.share());
    parallel_for(height, [&](int y) {
        const KernelTaps taps(weights, step, y, own.data());
        for (int x = 0; x < width; x += kernel_chunk)
            visit(y, KernelSums<planes>(from, taps, x));
    });
}

/// The means over the kernels around all pixels, by their weights.
/// @param means  of the same size, anything
template <std::size_t planes>
void write_kernel_means(const std::array<Plane, planes>& from, std::span<const Plane> weights, int step,
                        const ParallelFor& parallel_for, std::array<Plane, planes>& means) {
    for_kernel_sums(from, weights, step, parallel_for, [&](int y, const auto& sums) {
        for (std::size_t c = 0; c < planes; ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                means[c](x, y) = sums.values[c][x - sums.begin] / sums.weights[x - sums.begin];
    });
}

} // namespace tessera
