#include "recon/picture/guide_kernel.h"

#include <cmath>
#include <utility>

namespace tessera {

namespace {

// Tried on Veach, Ajar, Country Kitchen and Bathroom at 5 and 20 CPU seconds: none matters by more than a few
// percent when it is halved or doubled. What is nearer by a third is something else.
constexpr float albedo_width = 0.5f, normal_width = 0.3f, nearness_width = 0.3f; // of its logarithm
constexpr float roughness_width = 0.2f;                                          // of its root

/// Pixels of a row from (x, y) on, and as many from (to_x, to_y) on, each of which is compared with one of these.
struct PixelRuns {
    int x, y, to_x, to_y, count;
};

void weigh(const GuidePlanes& guides, const PixelRuns& runs, float share, float* weights) {
    for (const Plane& guide : guides) {
        if (guide.empty())
            continue;
        const float *here = guide.row(runs.y) + runs.x, *there = guide.row(runs.to_y) + runs.to_x;
        for (int i = 0; i < runs.count; ++i)
            weights[i] += (here[i] - there[i]) * (here[i] - there[i]);
    }
    for (int i = 0; i < runs.count; ++i) { // about exp(-unlike), and 0 from 8 on
        float w = std::max(0.0f, 1 - weights[i] * 0.125f);
        w *= w;
        w *= w;
        weights[i] = share * w * w;
    }
}

} // namespace

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

void write_pair_weights(const GuidePlanes& guides, int step, const ParallelFor& parallel_for,
                        PairWeights& weights) {
    const int width = weights[0].width(), height = weights[0].height();
    parallel_for(height, [&](int y) {
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const int shift = kernel_pairs[k].i * step, row = y + kernel_pairs[k].j * step;
            const int end = std::min(width, width - shift);
            for (int x = std::max(0, -shift); row < height && x < end; x += kernel_chunk)
                weigh(guides, {x, y, x + shift, row, std::min(kernel_chunk, end - x)}, kernel_pairs[k].share(),
                      weights[k].row(y) + x);
        }
    });
}

AlikePixels::AlikePixels(glm::ivec2 size, const GuideImages& guides, const ParallelFor& parallel_for) {
    const GuidePlanes planes = planes_of(guides, parallel_for);
    for (std::size_t level = 0; level < steps.size(); ++level) {
        make_planes(weights_[level], size.x, size.y);
        for (Plane& pair : weights_[level]) // nothing but guides makes pixels unlike
            parallel_for(size.y, [&](int y) { std::fill_n(pair.row(y), size.x, 0.0f); });
        write_pair_weights(planes, steps[level], parallel_for, weights_[level]);
    }
}

void AlikePixels::take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const {
    std::array<Plane, 1> from{std::move(values)}, to{Plane(from[0].width(), from[0].height(), Unfilled())};
    for (std::size_t level = 0; level < levels; ++level) {
        write_kernel_means(from, weights_[level], steps[level], parallel_for, to);
        std::swap(from, to);
    }
    values = std::move(from[0]);
}

} // namespace tessera
