#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstddef>

namespace tessera {

// Firefly suppression. A sample x of a pixel with n samples moves the pixel's mean by x / n. The brightest sample
// of a pixel is clamped to
//     t x,   t = min(1, max(firefly_factor, firefly_fraction n) mu / |x|),
// where |.| is a luminance and mu the mean of the other samples over 3x3 pixels, or firefly_own times the mean of
// the pixel's own other samples, whichever is larger: a pixel that is bright in every sample has no firefly. The
// gradients of the sample have a factor of their own: |x| becomes the largest of x and both gradients, and mu the
// largest of mu and of the means of the pixel's other gradients. As n grows, t goes to 1 for any x: the estimate
// is consistent. The clamped radiance is redistributed (recon/guided/redistribution.h), not dropped as outlier
// rejection does [Zirr 2018].
//
// Variances stay those of the raw samples, which best say how little is known of such a pixel.

/// Whether there are brightest samples and others to compare them with. Basis components have none.
bool can_clamp(const GradientImages& images);

/// Samples without fireflies, and the radiance that is missing from them.
struct ClampedSamples {
    GradientImages images; ///< primal, gradients, variances, halves and demodulation; all else is empty
    RgbImage clamped;      ///< mean radiance that was removed, >= 0 where the sample is
};

/// Clamps the brightest sample of each pixel. Needs can_clamp().
ClampedSamples clamp_fireflies(const GradientImages& images, const GuidedParameters& parameters,
                               const ParallelFor& parallel_for);

/// The radiance that clamp_fireflies() removes with the default parameters; black where it cannot be used.
RgbImage clamped_radiance(const GradientImages& images);

/// Bytes a pixel of ClampedSamples and of the means that decide on them.
std::size_t bytes_to_clamp(bool has_gradients, bool is_demodulated);

} // namespace tessera
