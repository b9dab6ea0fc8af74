// Weighted sums over the sparse kernels of the a-trous levels.
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

/// Gives all planes a size and leaves their pixels uninitialised.
template <class Number, std::size_t count>
void make_planes(std::array<Image<Number>, count>& planes, int width, int height) {
    for (Image<Number>& plane : planes)
        plane = Image<Number>(width, height, Unfilled());
}

/// Offset of a pixel pair, in steps. A kernel lists half of its offsets without the centre; the other half are the
/// same pairs seen from the second pixel.
struct KernelPair {
    int i, j;

    constexpr float share() const {
        constexpr float spline[] = {1 / 16.0f, 1 / 4.0f, 3 / 8.0f, 1 / 4.0f, 1 / 16.0f};
        return spline[i + 2] * spline[j + 2];
    }
};
inline constexpr std::array<KernelPair, 6> kernel_pairs = {{{1, 0}, {2, 0}, {0, 1}, {0, 2}, {1, 1}, {-1, 1}}};
// Number of leading pairs that lie in a row or a column. The filter uses these alone.
inline constexpr std::size_t straight_pairs = 4;

/// Weight of a pair relative to its spline weight, from 0 to most_weight (1), stored at the pair's first pixel. It
/// is a byte, since memory bandwidth limits the kernels. Weights of pairs that cross the border are never read.
using PairWeight = std::uint8_t;
inline constexpr float most_weight = 255;
using PairWeights = std::array<Image<PairWeight>, kernel_pairs.size()>;
using StraightWeights = std::array<Image<PairWeight>, straight_pairs>;

/// @param similarity  relative weight in [0, 1]
inline PairWeight pair_weight(float similarity) {
    return static_cast<PairWeight>(static_cast<int>(similarity * most_weight + 0.5f));
}

/// Columns that are processed at a time, so that their data stay in the cache.
inline constexpr int kernel_chunk = 512;

/// One kernel offset for a row of pixels: values are `shift` columns further in row `row`, and their weights, to
/// be multiplied by `scale`, `weight_shift` columns further.
struct KernelTap {
    const PairWeight* weights; ///< null: all are 1
    float scale;
    int row, shift, weight_shift;
};

/// Taps of row y, the centre first. Rows outside the picture are left out.
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

/// Weighted sums of values over the kernels around the pixels [begin, end) of a row.
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

    /// Writes the sums of the weights for the same pixels.
    void write_weights(float* sums) const { sum_up(nullptr, sums); }

private:
    /// A tap of this chunk: the pixels [begin, end), relative to the chunk, whose tap lies inside the picture, and
    /// row and column of the value for relative pixel 0.
    struct ChunkTap {
        int begin, end, row, column;
        float weights[kernel_chunk];
    };

    /// Converts the weights of a tap to floats, once for all planes.
    void add(const KernelTap& tap) {
        ChunkTap& chunk_tap = chunk_taps_[count_];
        chunk_tap.begin = std::max(0, -tap.shift - begin);
        chunk_tap.end = std::min(end, width_ - tap.shift) - begin;
        if (chunk_tap.begin >= chunk_tap.end)
            return;
        ++count_;
        chunk_tap.row = tap.row;
        chunk_tap.column = begin + tap.shift;
        const int first = begin + tap.weight_shift;
        for (int i = chunk_tap.begin; i < chunk_tap.end; ++i)
            chunk_tap.weights[i] = tap.scale * (tap.weights ? static_cast<float>(tap.weights[first + i]) : 1);
    }

    /// Sums in registers over the taps that all pixels of the chunk have, then adds the taps that some pixels
    /// lack. A loop over taps outside would load and store each sum once for each tap.
    /// @param plane  null: all values are 1
    void sum_up(const Plane* plane, float* sums) const {
        Term terms[KernelTaps::most];
        int count = 0;
        for (const ChunkTap* chunk_tap = chunk_taps_; chunk_tap != chunk_taps_ + count_; ++chunk_tap)
            if (is_whole(*chunk_tap))
                terms[count++] = {chunk_tap->weights,
                                  plane ? plane->row(chunk_tap->row) + chunk_tap->column : nullptr};
        sum_up(terms, count, sums);
        for (const ChunkTap* chunk_tap = chunk_taps_; chunk_tap != chunk_taps_ + count_; ++chunk_tap) {
            if (is_whole(*chunk_tap))
                continue;
            const float* row = plane ? plane->row(chunk_tap->row) : nullptr;
            for (int i = chunk_tap->begin; i < chunk_tap->end; ++i)
                sums[i] += chunk_tap->weights[i] * (row ? row[chunk_tap->column + i] : 1);
        }
    }

    bool is_whole(const ChunkTap& chunk_tap) const { return chunk_tap.begin == 0 && chunk_tap.end == end - begin; }

    /// A tap that all pixels of the chunk have.
    struct Term {
        const float *weights, *values; ///< values null: all are 1
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
    ChunkTap chunk_taps_[KernelTaps::most];
};

/// Calls visit(y, sums) for all pixels, a chunk of a row at a time.
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

/// Writes the weighted mean over the kernel of each pixel.
/// @param means  planes of the same size, any content
template <std::size_t planes>
void write_kernel_means(const std::array<Plane, planes>& from, std::span<const Image<PairWeight>> weights,
                        int step, const ParallelFor& parallel_for, std::array<Plane, planes>& means) {
    for_kernel_sums(from, weights, step, parallel_for, [&](int y, const auto& sums) {
        float weight_sums[kernel_chunk];
        sums.write_weights(weight_sums);
        for (std::size_t c = 0; c < planes; ++c)
            for (int x = sums.begin; x < sums.end; ++x)
                means[c](x, y) = sums.values[c][x - sums.begin] / weight_sums[x - sums.begin];
    });
}

} // namespace tessera
