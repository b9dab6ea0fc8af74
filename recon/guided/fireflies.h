#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstddef>

namespace tessera {

// Firefly suppression, reconstruction (56) to (58). A sample x of a pixel with n samples moves the pixel's mean by
// x / n. The brightest sample of a pixel is clamped to
//     t x,   t = min(1, max(firefly_factor, firefly_fraction n) mu / |x|),
// where |.| is a luminance. mu is the mean of the other samples over 3x3 pixels, or firefly_own times the mean of
// the pixel's own other samples, whichever is larger: a pixel that is bright in every sample has no firefly. The
// gradients of the sample have their own factor: |x| becomes the largest of |x| and both gradients, and mu the
// largest of mu and the means of the pixel's other gradients. As n grows, t goes to 1 for any x: the estimate is
// consistent. The clamped radiance is redistributed (recon/guided/redistribution.h), not dropped as in outlier
// rejection [Zirr 2018].
//
// Variances stay those of the raw samples, which show best how little is known of such a pixel.

/// Returns whether each pixel has a brightest sample and others to compare it with. Basis components have none.
bool can_clamp(const GradientImages& images);

/// Means without fireflies, and the radiance that was removed from them.
struct ClampedSamples {
    GradientImages images; ///< primal, gradients, variances, halves and demodulation; the rest is empty
    RgbImage clamped;      ///< H of reconstruction (58), radiance removed from the mean; >= 0 where the sample is
};

/// Clamps the brightest sample of each pixel. Needs can_clamp().
ClampedSamples clamp_fireflies(const GradientImages& images, const GuidedParameters& parameters,
                               const ParallelFor& parallel_for);

/// Returns the radiance that clamp_fireflies() removes with the default parameters; black if can_clamp() is false.
RgbImage clamped_radiance(const GradientImages& images);

/// Returns the bytes a pixel of ClampedSamples and of the scratch images of clamp_fireflies().
std::size_t bytes_to_clamp(bool has_gradients, bool is_demodulated);

} // namespace tessera
