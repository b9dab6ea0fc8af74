#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

namespace tessera {

// What a pixel's own samples say of it. A solver gives a dark pixel beside a bright one some of the noise about, and
// spikes that are held back are given to the pixels around (recon/spikes.h): little for a bright pixel, far too much
// for the bar of a window in front of the sky. But where pixels share their paths, a dark pixel has seen what its
// neighbours have seen, and knows that it is dark. So the picture is kept within
//     P - 2 s <= I <= P + 2 s ,
// where P is the pixel's own radiance and s its standard error. This is consistent, as s goes to 0 with the samples;
// and the picture is not linear in them.
//
// s^2 is the variance of P, or its geometric mean over the 5x5 pixels around, whichever is larger: a dark pixel
// among dark ones is held to what it knows, one that is dark by chance among bright ones is not. An arithmetic mean
// would be ruled by one bright pixel.
//
// Where each pixel has paths of its own alone, being dark by chance is the rule, and neighbours do not tell: nothing
// is done there (GradientImages::patch is 1).

/// Whether there are variances, and pixels that share their paths.
bool can_bound(const GradientImages& images);

/// Keeps `image`, radiance without very direct light, within the bounds of `images`, whose spikes may be limited.
/// Takes three floats a pixel, which is less than spread() takes and gives back before.
void keep_within_bounds(const GradientImages& images, RgbImage& image, const ParallelFor& parallel_for);

} // namespace tessera
