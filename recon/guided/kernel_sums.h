// Weighted sums over the pixels of small kernels, whose pixels may be far apart.
#pragma once

#include "recon/image.h"
#include "recon/lanes.h"
#include "recon/parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera {

using Plane = Image<float>;

/// Planes of a size, with anything in them.
template <class Number, std::size_t count>
void make_planes(std::array<Image<Number>, count>& planes, int width, int height) {
    for (Image<Number>& plane : planes)
        plane = Image<Number>(width, height, Unfilled());
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

/// How much of a pair's share its two pixels count for each other, or those of the first pairs, at the first of
/// the two: most_weight is all, 0 nothing. A byte, as kernels take as long as their memory does. What stands for a
/// pair that reaches beyond the picture does not matter.
using PairWeight = std::uint8_t;
inline constexpr float most_weight = 255;
using PairWeights = std::array<Image<PairWeight>, kernel_pairs.size()>;
using StraightWeights = std::array<Image<PairWeight>, straight_pairs>;

/// @param part  of the pair's share, in [0, 1]
inline PairWeight pair_weight(float part) {
    return static_cast<PairWeight>(static_cast<int>(part * most_weight + 0.5f));
}

/// Columns that are worked on at a time, so that all about them stays at hand.
inline constexpr int kernel_chunk = 512;

/// Pixels that the kernels of a row take: those `shift` columns on in a row, whose weights stand `place` columns
/// on in another and are to be multiplied by `scale`.
struct KernelTap {
    const PairWeight* weights; ///< null: all are 1
    float scale;
    int row, shift, place;
};

/// The taps of a row, first the row's own pixels: those in rows beyond the picture are left out.
class KernelTaps {
public:
    KernelTaps(std::span<const Image<PairWeight>> weights, int step, int y) {
        taps_[0] = {nullptr, KernelPair{0, 0}.share(), y, 0, 0};
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const float scale = kernel_pairs[k].share() / most_weight;
            const int shift = kernel_pairs[k].i * step;
            const int above = y - kernel_pairs[k].j * step, below = y + kernel_pairs[k].j * step;
            if (below < weights[k].height())
                taps_[count_++] = {weights[k].row(y), scale, below, shift, 0};
            if (above >= 0)
                taps_[count_++] = {weights[k].row(above), scale, above, -shift, -shift};
        }
    }

    const KernelTap* begin() const { return taps_; }
    const KernelTap* end() const { return taps_ + count_; }

    static constexpr std::size_t most = 2 * kernel_pairs.size() + 1;

private:
    KernelTap taps_[most];
    int count_ = 1;
};

/// Values times weights, summed over the kernels around the pixels [begin, end) of a row.
template <std::size_t planes>
class KernelSums {
public:
    int begin, end;
    float values[planes][kernel_chunk];

    KernelSums(const std::array<Plane, planes>& from, const KernelTaps& taps, int x)
        : begin(x), end(std::min(x + kernel_chunk, from[0].width())), width_(from[0].width()) {
        for (const KernelTap& tap : taps)
            add(tap);
        for (std::size_t c = 0; c < planes; ++c)
            sum_up(&from[c], values[c]);
    }

    /// Writes the sums of the weights alone, of as many pixels.
    void write_weights(float* sums) const { sum_up(nullptr, sums); }

private:
    /// Of a tap: the pixels [begin, end) that have it, from the row's `begin` on, and the place of the first one's
    /// value.
    struct Part {
        int begin, end, row, column;
        float weights[kernel_chunk];
    };

    /// Weights are made numbers once for all planes.
    void add(const KernelTap& tap) {
        Part& part = parts_[count_];
        part.begin = std::max(0, -tap.shift - begin);
        part.end = std::min(end, width_ - tap.shift) - begin;
        if (part.begin >= part.end)
            return;
        ++count_;
        part.row = tap.row;
        part.column = begin + tap.shift;
        const int first = begin + tap.place;
        for (int i = part.begin; i < part.end; ++i)
            part.weights[i] = tap.scale * (tap.weights ? static_cast<float>(tap.weights[first + i]) : 1);
    }

    /// Sums are made in registers where all pixels have a tap, and taps beyond the row's ends follow for those
    /// that do. (A tap at a time for all planes, sums would be fetched and put back for each: 1.1 to 1.5 times the
    /// time.)
    /// @param plane  null: ones
    void sum_up(const Plane* plane, float* sums) const {
        Term terms[KernelTaps::most];
        int count = 0;
        for (const Part* part = parts_; part != parts_ + count_; ++part)
            if (is_whole(*part))
                terms[count++] = {part->weights, plane ? plane->row(part->row) + part->column : nullptr};
        sum_up(terms, count, sums);
        for (const Part* part = parts_; part != parts_ + count_; ++part) {
            if (is_whole(*part))
                continue;
            const float* row = plane ? plane->row(part->row) : nullptr;
            for (int i = part->begin; i < part->end; ++i)
                sums[i] += part->weights[i] * (row ? row[part->column + i] : 1);
        }
    }

    bool is_whole(const Part& part) const { return part.begin == 0 && part.end == end - begin; }

    /// Of a tap that all pixels have.
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

    int width_, count_ = 0;
    Part parts_[KernelTaps::most];
};

/// Calls visit(y, sums) for all pixels, some of a row at a time.
template <std::size_t planes, class Visit>
void for_kernel_sums(const std::array<Plane, planes>& from, std::span<const Image<PairWeight>> weights, int step,
                     const ParallelFor& parallel_for, Visit&& visit) {
    const int width = from[0].width(), height = from[0].height();
    parallel_for(height, [&](int y) {
        const KernelTaps taps(weights, step, y);
        for (int x = 0; x < width; x += kernel_chunk)
            visit(y, KernelSums<planes>(from, taps, x));
    });
}

/// The means over the kernels around all pixels, by their weights.
/// @param means  of the same size, anything
template <std::size_t planes>
void write_kernel_means(const std::array<Plane, planes>& from, std::span<const Image<PairWeight>> weights,
                        int step, const ParallelFor& parallel_for, std::array<Plane, planes>& means) {
    for_kernel_sums(from, weights, step, parallel_for, [&](int y, const auto& sums) {
        float of_weights[kernel_chunk];
        sums.write_weights(of_weights);
        for (std::size_t c = 0; c < planes; ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                means[c](x, y) = sums.values[c][x - sums.begin] / of_weights[x - sums.begin];
    });
}

} // namespace tessera
