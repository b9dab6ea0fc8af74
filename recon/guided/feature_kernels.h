#pragma once

#include "recon/guided/kernel_sums.h"
#include "recon/image.h"
#include "recon/local_brightness.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

namespace tessera {

// Kernels of pixels with similar features: the 13 of 5x5 pixels with |i| + |j| <= 2, a step apart [the a trous
// wavelets of Dammertz 2010], whose weight is that of a cubic spline times about
//     exp(-sum of (differences of features / widths)^2) .
// The weight of a pair is the same from both sides.

/// Features over the widths that GuidedParameters gives. Empty planes: there are none, and all pixels are similar.
inline constexpr int feature_count = 8;
using FeaturePlanes = std::array<Plane, feature_count>;

/// Kernels at several distances: with five steps, each three times as wide as the last, they reach 240 pixels.
class FeatureKernels {
public:
    static constexpr std::array steps = {1, 3, 9, 27, 81};

    /// Without features, all pixels are similar.
    FeatureKernels(glm::ivec2 size, const FeatureImages& features, const GuidedParameters& parameters,
                   const ParallelFor& parallel_for);

    const FeaturePlanes& features() const { return features_; }

    /// Weights of the pairs that are steps[level] apart.
    const PairWeights& weights(std::size_t level) const { return weights_[level]; }

    /// Replaces values by their means over the kernels of the first levels, one after the other.
    void take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const;

    std::size_t bytes() const;
    /// At most.
    static constexpr std::size_t bytes_a_pixel =
        steps.size() * kernel_pairs.size() * sizeof(PairWeight) + feature_count * sizeof(float);

private:
    FeaturePlanes features_;
    std::array<PairWeights, steps.size()> weights_;
};

/// Planes of the image's size that weights of a level are made in; any content.
struct WeightScratch {
    Plane pairs, rows;
};

/// Writes the weights of straight pairs for a noisy brightness: the weights by features times about exp(-u), where
/// u is the mean, over all pairs in the same direction in a square three quarters as wide as the kernel, of the
/// squared difference of brightness over square_width variances of its noise. Squares decide, as patches do in
/// non-local means [Buades 2005]: single pixels with much noise do not, and a pattern that noise hides between two
/// pixels is found.
/// @param by_features  weights of pairs `step` apart
/// @param brightness   its logarithm
/// @param noise        variance of the noise of that
void write_noisy_weights(const PairWeights& by_features, const Plane& brightness, const Plane& noise, int step,
                         const GuidedParameters& parameters, const ParallelFor& parallel_for,
                         WeightScratch& scratch, StraightWeights& weights);

} // namespace tessera
