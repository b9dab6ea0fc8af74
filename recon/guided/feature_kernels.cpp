#include "recon/guided/feature_kernels.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <cmath>
#include <utility>
#include <vector>

namespace tessera {

namespace {

/// The pixels [begin, end) of a row or column that have a pixel `step` further on.
struct PairedPixels {
    int size, begin, end;

    PairedPixels(int all, int step)
        : size(all), begin(std::clamp(-step, 0, all)), end(std::clamp(all - step, begin, all)) {}

    /// Returns the factor that turns a mean over all pixels within the radius into one over the paired pixels, if
    /// the others are 0.
    float paired_mean_factor(int x, int radius) const {
        const int all = std::min(size, x + radius + 1) - std::max(0, x - radius);
        const int paired = std::min(end, x + radius + 1) - std::max(begin, x - radius);
        return static_cast<float>(all) / static_cast<float>(paired);
    }
};

/// `count` pixels of a row from (x, y) on, and the pixels from (to_x, to_y) on with which they are compared.
struct PixelRuns {
    int x, y, to_x, to_y, count;
};

/// Returns s of reconstruction (44), about exp(-u), and 0 for u >= 8.
float similarity(float u) {
    float w = std::max(0.0f, 1 - u * 0.125f);
    w *= w;
    w *= w;
    return w * w;
}

/// Writes the weights by features, each at the first pixel of its pair.
void weigh(const FeaturePlanes& features, const PixelRuns& runs, PairWeight* weights) {
    float distance[kernel_chunk] = {};
    for (const Plane& feature : features) {
        if (feature.empty())
            continue;
        const float *here = feature.row(runs.y) + runs.x, *there = feature.row(runs.to_y) + runs.to_x;
        for (int i = 0; i < runs.count; ++i)
            distance[i] += (here[i] - there[i]) * (here[i] - there[i]);
    }
    for (int i = 0; i < runs.count; ++i)
        weights[i] = pair_weight(similarity(distance[i]));
}

void write_weights_by_features(const FeaturePlanes& features, int step, const ParallelFor& parallel_for,
                               PairWeights& weights) {
    const int width = weights[0].width(), height = weights[0].height();
    parallel_for(height, [&](int y) {
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const KernelPair apart{kernel_pairs[k].i * step, kernel_pairs[k].j * step};
            const PairedPixels columns(width, apart.i), rows(height, apart.j);
            for (int x = columns.begin; y < rows.end && x < columns.end; x += kernel_chunk)
                weigh(features, {x, y, x + apart.i, y + apart.j, std::min(kernel_chunk, columns.end - x)},
                      weights[k].row(y) + x);
        }
    });
}

/// Calls visit(i, d) for the pixels columns.begin + i of row y, with d of reconstruction (49): the squared
/// difference of log brightness to the pixel a step further on, over the variance of their noise.
/// @param brightness, noise  logarithm of the brightness, and the variance of its noise
template <class Visit>
void for_distances(const Plane& brightness, const Plane& noise, int y, KernelPair step, PairedPixels columns,
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

FeaturePlanes planes_of(const FeatureImages& features, const GuidedParameters& parameters,
                        const ParallelFor& parallel_for) {
    FeaturePlanes planes;
    if (features.empty())
        return planes;
    const int width = features.albedo.width(), height = features.albedo.height();
    make_planes(planes, width, height);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        constexpr float farthest = 1e-10f; // inverse distance that stands for infinity
        for (int c = 0; c < 3; ++c) {
            planes[c].data()[i] = features.albedo.data()[i][c] / parameters.feature_width;
            planes[c + 3].data()[i] = features.normal.data()[i][c] / parameters.feature_width;
        }
        planes[6].data()[i] = std::log(std::max(features.nearness.data()[i], farthest)) / parameters.feature_width;
        planes[7].data()[i] = std::sqrt(std::max(features.roughness.data()[i], 0.0f)) / parameters.roughness_width;
    });
    return planes;
}

} // namespace

FeatureKernels::FeatureKernels(glm::ivec2 size, const FeatureImages& features, const GuidedParameters& parameters,
                               const ParallelFor& parallel_for)
    : features_(planes_of(features, parameters, parallel_for)) {
    for (std::size_t level = 0; level < steps.size(); ++level) {
        make_planes(weights_[level], size.x, size.y);
        write_weights_by_features(features_, steps[level], parallel_for, weights_[level]);
    }
}

std::size_t FeatureKernels::bytes() const {
    return steps.size() * kernel_pairs.size() * sizeof(PairWeight) * weights_[0][0].size() +
           feature_count * sizeof(float) * features_[0].size();
}

void FeatureKernels::take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const {
    std::array<Plane, 1> from{std::move(values)}, to{Plane(from[0].width(), from[0].height(), Unfilled())};
    for (std::size_t level = 0; level < levels; ++level) {
        write_kernel_means(from, weights_[level], steps[level], parallel_for, to);
        std::swap(from, to);
    }
    values = std::move(from[0]);
}

void write_noisy_weights(const PairWeights& by_features, const Plane& brightness, const Plane& noise, int step,
                         const GuidedParameters& parameters, const ParallelFor& parallel_for,
                         WeightScratch& scratch, StraightWeights& weights) {
    Plane& pairs = scratch.pairs;
    const int width = noise.width(), height = noise.height(), radius = (3 * step + 1) / 2;
    std::vector<float> scales(static_cast<std::size_t>(width));
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const KernelPair apart{kernel_pairs[k].i * step, kernel_pairs[k].j * step};
        const PairedPixels columns(width, apart.i), rows(height, apart.j);
        parallel_for(height, [&](int y) {
            float* row = pairs.row(y);
            std::fill_n(row, width, 0.0f);
            if (y < rows.end)
                for_distances(brightness, noise, y, apart, columns,
                              [=](int i, float distance) { row[columns.begin + i] = distance; });
        });
        take_wide_means(pairs, radius, scratch.rows, parallel_for);
        for (int x = columns.begin; x < columns.end; ++x)
            scales[x] = columns.paired_mean_factor(x, radius) / parameters.square_width;
        parallel_for(rows.end, [&](int y) {
            const float scale = rows.paired_mean_factor(y, radius);
            const float* squares = pairs.row(y);
            const PairWeight* by_feature = by_features[k].row(y);
            PairWeight* row = weights[k].row(y);
            for (int x = columns.begin; x < columns.end; ++x)
                row[x] = pair_weight(static_cast<float>(by_feature[x]) / most_weight *
                                     similarity(scale * scales[x] * squares[x]));
        });
    }
}

} // namespace tessera
