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

// Kernels of pixels with similar features, reconstruction (43) and (44): the 13 of 5x5 pixels with |i| + |j| <= 2,
// a step apart [a-trous wavelets, Dammertz 2010]. The weight is that of a cubic spline times about
//     exp(-sum of (differences of features / widths)^2) .
// A pair has the same weight from both sides.

/// Features divided by the widths of GuidedParameters, reconstruction (43). Empty planes: unknown, all pixels are
/// similar.
inline constexpr int feature_count = 8;
using FeaturePlanes = std::array<Plane, feature_count>;

/// Kernels at five levels, each three times as wide as the last. Together they reach 242 pixels.
class FeatureKernels {
public:
    static constexpr std::array steps = {1, 3, 9, 27, 81};

    /// Without features, all pixels are similar.
    FeatureKernels(glm::ivec2 size, const FeatureImages& features, const GuidedParameters& parameters,
                   const ParallelFor& parallel_for);

    const FeaturePlanes& features() const { return features_; }

    /// Returns the weights of pairs with offsets in units of steps[level].
    const PairWeights& weights(std::size_t level) const { return weights_[level]; }

    /// Replaces values by their weighted means over the kernels of the first levels, one after the other.
    void take_means(std::size_t levels, Plane& values, const ParallelFor& parallel_for) const;

    std::size_t bytes() const;
    /// Upper limit.
    static constexpr std::size_t bytes_a_pixel =
        steps.size() * kernel_pairs.size() * sizeof(PairWeight) + feature_count * sizeof(float);

private:
    FeaturePlanes features_;
    std::array<PairWeights, steps.size()> weights_;
};

/// Scratch planes of the image's size, any content.
struct WeightScratch {
    Plane pairs, rows;
};

/// Writes the weights of the pairs in rows and columns for a noisy brightness, reconstruction (48) and (49). Each
/// is the weight by features times about exp(-D / square_width). D is a mean over all pairs with the same offset
/// in a square three quarters as wide as the kernel: the mean squared difference of brightness over the variance
/// of its noise. Squares decide, as patches do in non-local means [Buades 2005]. A single noisy pixel does not,
/// and a pattern that noise hides between two pixels is found.
/// @param by_features  weights by features of pairs `step` apart
/// @param brightness   logarithm of the brightness
/// @param noise        variance of the noise of that logarithm, reconstruction (50)
void write_noisy_weights(const PairWeights& by_features, const Plane& brightness, const Plane& noise, int step,
                         const GuidedParameters& parameters, const ParallelFor& parallel_for,
                         WeightScratch& scratch, StraightWeights& weights);

} // namespace tessera
