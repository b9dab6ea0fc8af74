#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/guided.h"

namespace tessera {

// Two pictures of the same: one without bias, but noisy; another, smoother, that may be wrong, as a denoiser's.
// What the two differ by, d, is the noise of the first and the error of the second. Shrunk toward the second
// [James and Stein 1961], the first has less error in the mean, however wrong the second is, if the errors of both
// have little in common:
//     I + w d,   w = min(1/2, mean of noise^2 / mean of d^2) ,
// means over the pixels around. With ever more samples noise goes to 0, and w with it, where the second is wrong.

/// Radiance, as the picture's and the target's; their light is compared over the albedo of `guides`, if there are
/// any, and beside its brightness. Empty noise: the target. The same bits for any parallel_for.
RgbImage shrink_toward(const RgbImage& target, NoisyPicture picture, const GuideImages& guides,
                       const ParallelFor& parallel_for);

} // namespace tessera
