#include "recon/picture/guide_kernel.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <cmath>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// Tried on Veach, Ajar, Country Kitchen and Bathroom at 5 and 20 CPU seconds: none matters by more than a few
// percent when it is halved or doubled. What is nearer by a third is something else.
constexpr float albedo_width = 0.5f, normal_width = 0.3f, nearness_width = 0.3f; // of its logarithm
constexpr float roughness_width = 0.2f;                                          // of its root

// What counts as unlike where two pixels are compared, and where the squares around them are. Tried on Veach,
// Ajar, Country Kitchen, Bathroom and The Grey & White Room, 4 and about 15 samples: none matters by more than
// half a percent of FLIP when it is changed by a third.
constexpr float pixel_width = 20, square_width = 3.5f;
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

/// Pixels of a row from (x, y) on, and as many from (to_x, to_y) on, each of which is compared with one of these.
struct PixelRuns {
    int x, y, to_x, to_y, count;
};

/// About exp(-unlike), and 0 from 8 on.
float alikeness(float unlike) {
    float w = std::max(0.0f, 1 - unlike * 0.125f);
    w *= w;
    w *= w;
    return w * w;
}

/// @param weights  in a row, at the first of each pair
void weigh(const GuidePlanes& guides, const PixelRuns& runs, PairWeight* weights) {
    float unlike[kernel_chunk] = {};
    for (const Plane& guide : guides) {
        if (guide.empty())
            continue;
        const float *here = guide.row(runs.y) + runs.x, *there = guide.row(runs.to_y) + runs.to_x;
        for (int i = 0; i < runs.count; ++i)
            unlike[i] += (here[i] - there[i]) * (here[i] - there[i]);
    }
    for (int i = 0; i < runs.count; ++i)
        weights[i] = pair_weight(alikeness(unlike[i]));
}

void write_weights_by_guides(const GuidePlanes& guides, int step, const ParallelFor& parallel_for,
                             PairWeights& weights) {
    const int width = weights[0].width(), height = weights[0].height();
    parallel_for(height, [&](int y) {
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const KernelPair apart{kernel_pairs[k].i * step, kernel_pairs[k].j * step};
            const PairedPixels columns(width, apart.i), rows(height, apart.j);
            for (int x = columns.begin; y < rows.end && x < columns.end; x += kernel_chunk)
                weigh(guides, {x, y, x + apart.i, y + apart.j, std::min(kernel_chunk, columns.end - x)},
                      weights[k].row(y) + x);
        }
    });
}

/// Calls visit(i, unlike) for the i-th of some pixels of row y: by what their brightness differs from that of
/// those a step on, squared, in variances of its noise.
/// @param brightness, noise  logarithm, and the variance of its noise
template <class Visit>
void for_unlikeness(const Plane& brightness, const Plane& noise, int y, KernelPair step, PairedPixels columns,
                    const Visit& visit) {
    if (columns.begin == columns.end)
        return;
    const int here = columns.begin, there = columns.begin + step.i;
    const float *own = brightness.row(y) + here, *other = brightness.row(y + step.j) + there;
    const float *own_noise = noise.row(y) + here, *other_noise = noise.row(y + step.j) + there;
    for (int i = 0; i < columns.end - columns.begin; ++i) {
        const float d = own[i] - other[i];
        visit(i, d * d / (own_noise[i] + other_noise[i] + 1e-7f));
    }
}

GuidePlanes planes_of(const GuideImages& guides, const ParallelFor& parallel_for) {
    GuidePlanes planes;
    if (guides.empty())
        return planes;
    const int width = guides.albedo.width(), height = guides.albedo.height();
    make_planes(planes, width, height);
    const double sum =
        sum_over_pixels(width, height, parallel_for, [&](std::size_t i) { return guides.nearness.data()[i]; });
    const float least = sum > 0 ? static_cast<float>(1e-3 * sum / static_cast<double>(guides.nearness.size())) : 1;
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        for (int c = 0; c < 3; ++c) {
            planes[static_cast<std::size_t>(c)].data()[i] = guides.albedo.data()[i][c] / albedo_width;
            planes[static_cast<std::size_t>(c + 3)].data()[i] = guides.normal.data()[i][c] / normal_width;
        }
        planes[6].data()[i] = std::log(std::max(guides.nearness.data()[i], 0.0f) + least) / nearness_width;
        planes[7].data()[i] = std::sqrt(std::max(guides.roughness.data()[i], 0.0f)) / roughness_width;
    });
    return planes;
}

} // namespace

AlikePixels::AlikePixels(glm::ivec2 size, const GuideImages& guides, const ParallelFor& parallel_for)
    : guides_(planes_of(guides, parallel_for)) {
    for (std::size_t level = 0; level < steps.size(); ++level) {
        make_planes(weights_[level], size.x, size.y);
        write_weights_by_guides(guides_, steps[level], parallel_for, weights_[level]);
    }
}

std::size_t AlikePixels::bytes() const {
    return steps.size() * kernel_pairs.size() * sizeof(PairWeight) * weights_[0][0].size() +
           guide_count * sizeof(float) * guides_[0].size();
}

void AlikePixels::take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const {
    std::array<Plane, 1> from{std::move(values)}, to{Plane(from[0].width(), from[0].height(), Unfilled())};
    for (std::size_t level = 0; level < levels; ++level) {
        write_kernel_means(from, weights_[level], steps[level], parallel_for, to);
        std::swap(from, to);
    }
    values = std::move(from[0]);
}

void write_noisy_weights(const PairWeights& by_guides, const Plane& brightness, const Plane& noise, int step,
                         const ParallelFor& parallel_for, Plane& pairs, Plane& square_rows,
                         StraightWeights& weights) {
    const int width = noise.width(), height = noise.height(), radius = (3 * step + 1) / 2;
    std::vector<float> shares(static_cast<std::size_t>(width));
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const KernelPair apart{kernel_pairs[k].i * step, kernel_pairs[k].j * step};
        const PairedPixels columns(width, apart.i), rows(height, apart.j);
        parallel_for(height, [&](int y) {
            float* row = pairs.row(y);
            std::fill_n(row, width, 0.0f);
            if (y < rows.end)
                for_unlikeness(brightness, noise, y, apart, columns,
                               [=](int i, float own) { row[columns.begin + i] = std::min(own, most_unlike); });
        });
        take_wide_means(pairs, radius, square_rows, parallel_for);
        for (int x = columns.begin; x < columns.end; ++x)
            shares[static_cast<std::size_t>(x)] = columns.of_paired(x, radius) / square_width;
        parallel_for(rows.end, [&](int y) {
            const float share = rows.of_paired(y, radius);
            for (PairedPixels run = columns; run.begin < columns.end; run.begin = run.end) {
                run.end = std::min(run.begin + kernel_chunk, columns.end);
                const float *squares = pairs.row(y) + run.begin, *whole = shares.data() + run.begin;
                const PairWeight* guided = by_guides[k].row(y) + run.begin;
                float parts[kernel_chunk];
                for_unlikeness(brightness, noise, y, apart, run, [&, squares, whole, guided](int i, float own) {
                    const float of_square = share * whole[i] * squares[i];
                    const float by_guide = static_cast<float>(guided[i]) / most_weight;
                    parts[i] = by_guide * alikeness(0.5f * (own / pixel_width + of_square));
                });
                PairWeight* row = weights[k].row(y) + run.begin;
                for (int i = 0; i < run.end - run.begin; ++i)
                    row[i] = pair_weight(parts[i]);
            }
        });
    }
}

} // namespace tessera
