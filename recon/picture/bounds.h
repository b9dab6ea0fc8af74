#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

#include <cstdint>

namespace tessera {

// How bright a pixel may be, as far as its own samples know. A solver gives a dark pixel beside a bright one some
// of the noise about, and spikes that are held back are given to the pixels around (recon/picture/spikes.h):
// little for a bright pixel, far too much for the bar of a window in front of the sky. But where pixels share
// their paths, a dark pixel has seen what its neighbours have seen, and knows that it is dark. So the picture is
// kept below
//     P + 2 s ,
// where P is what the primal alone says, and s its standard error; what is above goes to the pixels around. This
// is consistent, as s goes to 0 with the samples; and the picture is not linear in them.
//
// s is the standard error of P, or its mean over the pixels around that look alike, wider than a tile, whichever
// is larger: the bar of a window among the bar's pixels is held to what it knows, and a tile on a wall that is
// dark by chance is not. The mean is of roots: others would be ruled by one bright pixel.
//
// Where fewer than half the pixels around, in a square wider than a tile, have found any light, whole tiles are
// dark by chance: there are no bounds. Where each pixel has paths of its own alone, being dark by chance is the
// rule, and neighbours do not tell: nothing is done there (GradientImages::patch is 1).

// A pixel that sees nothing, by its guides, and in which no sample has found light is black, whatever method it is
// of: behind things that stand before nothing there is no glow.

/// Whether there are variances, and pixels that share their paths.
bool can_bound(const GradientImages& images);

/// P and s, radiance without very direct light. P is the picture that the primal makes, or the mean of its samples
/// where that is more; s is 1e30 where there are no bounds. Both are empty where can_bound() is false.
struct UpperBounds {
    RgbImage light, error;
    Image<std::uint8_t> black; ///< 1 where a pixel sees nothing; empty: there are no guides

    bool empty() const { return light.empty() && black.empty(); }
};
/// @param images  without what spikes hold back
/// @param given   with it, and with guides, if there are any
/// @param alike   by these; without guides all pixels look alike, and a dark bar knows no better
UpperBounds upper_bounds(const GradientImages& images, const GradientImages& given, const AlikePixels& alike,
                         const ParallelFor& parallel_for);

/// Takes what is above P + reach s, and all of a black pixel, from the image, and returns it.
RgbImage take_excess(const UpperBounds& bounds, float reach, RgbImage& image, const ParallelFor& parallel_for);

/// How much more light each pixel may have below P + reach s; none where it is black. Empty: any.
RgbImage room_below(const UpperBounds& bounds, float reach, const RgbImage& image,
                    const ParallelFor& parallel_for);

} // namespace tessera
