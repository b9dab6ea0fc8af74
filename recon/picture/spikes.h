#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstddef>
#include <cstdint>

namespace tessera {

// Spikes: light that few samples find and that is then far too bright where they do, or all over their tile. A
// sample x of a pixel moves its mean by x / n. As long as that is much beside what the other samples say, nothing
// is known of it but that there is light about; so the most of it is held back from the pixel, with the gradients
// that came with it, and given to all the pixels around, each by its brightness:
//     x counts as t x,   t = min(1, max(2, n / 4) mu / |x|),
// where mu is the mean of the other samples over the 3x3 pixels around, or half that of the pixel's own, whichever
// is larger, and |.| a luminance. Its gradients count as much, or less where they are larger than x, unless the
// other samples' are as well. With n samples, more and more of any x is let through, so that the picture is
// consistent: it goes to that without limits. No light is lost on the way, as with dropping outliers [Zirr 2018
// has a survey], but it is smoothed, and the picture is not linear in its samples.
//
// Variances stay as they are: what a pixel was before its spike was limited says best how little is known of it.
//
// So gradients stay differences: all that a tile shares out is in the same sample of all its pixels. Where a spike
// lights one of two neighbours, the gradient between them is limited as its pixel is.

/// Whether there are brightest samples to look at, and any others to judge them by. Parts have none.
bool can_limit(const GradientImages& images);

/// The images with limited samples: primal, gradients, halves, and what of a Demodulation depends on them. Left
/// out are very direct light, guides and each pixel's own, which no limits change, parts, of which there are none,
/// and the brightest samples but for their halves: nothing is left to limit.
/// @param with_halves  false: these are left out, too
/// @param held         becomes the radiance that is held back; black where there is nothing
GradientImages limited(const GradientImages& images, bool with_halves, RgbImage& held,
                       const ParallelFor& parallel_for);

/// The radiance that limited() holds back; black where it is not to be used.
RgbImage held_light(const GradientImages& images);

/// The memory that limited(), AlikePixels, spreading and upper_bounds() (recon/picture/bounds.h) take, a pixel.
std::size_t bytes_to_limit(bool has_gradients, bool is_demodulated);

} // namespace tessera
