#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/kernel_sums.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace tessera {

// Kernels that join pixels which look alike: the 13 of 5x5 pixels with |i| + |j| <= 2, a step apart [the a trous
// wavelets of Dammertz 2010], in which a pixel weighs its share of a cubic spline times about
//     exp(-sum of (differences of guides / widths)^2) .
// Two pixels weigh as much for each other as the other way round.

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

    std::size_t bytes() const;
    /// At the most.
    static constexpr std::size_t bytes_a_pixel =
        steps.size() * kernel_pairs.size() * sizeof(PairWeight) + guide_count * sizeof(float);

private:
    GuidePlanes guides_;
    std::array<PairWeights, steps.size()> weights_;
};

/// The weights of straight pairs whose brightness tells, too, and is noisy: those by guides times about exp(-u),
/// where u is how unlike the brightness is, half by the two pixels alone, half by all pairs in the same direction
/// from a square three quarters as wide as the kernel, as patches tell in non-local means [Buades 2005]. Of noise
/// a few pixels have much, and look unlike by it alone; and a pattern that noise hides between two pixels is seen
/// in a square. (A straight edge is rather diluted there.)
/// @param by_guides   of pairs `step` apart
/// @param brightness  its logarithm
/// @param noise       the variance of its noise
/// @param pairs, square_rows, weights  of the picture's size, anything; the first two are of no use after
void write_noisy_weights(const PairWeights& by_guides, const Plane& brightness, const Plane& noise, int step,
                         const ParallelFor& parallel_for, Plane& pairs, Plane& square_rows,
                         StraightWeights& weights);

} // namespace tessera
