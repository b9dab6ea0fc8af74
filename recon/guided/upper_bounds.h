#pragma once

#include "recon/guided/feature_kernels.h"
#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

namespace tessera {

// Upper bounds, reconstruction (61) and (62). A solver and a filter give a dark pixel beside a bright one some of
// the light beside it: little for the bright pixel, far too much for the frame of a sunlit window. Where pixels
// share their paths, a dark pixel has seen the paths of its neighbours and knows that it is dark. The picture is
// limited to P + bound_reach s, with P as the radiance that the pixel's own samples give and s as its standard
// error. The limit is consistent, as s goes to 0 and P to the radiance.

/// Returns whether bounds apply: there are variances, pixels share their paths (GradientImages::patch is above 1),
/// and there are no basis components. A pixel that has only its own paths is often dark by chance.
bool can_bound(const GradientImages& images);

/// Returns the upper bounds, as radiance without directly visible emission. s is the larger of the pixel's own
/// standard error and the mean over pixels with similar features, so that a tile that is dark by chance is not
/// bound to that. Bounds are infinite where less than `bound_lit` of the surrounding pixels found any light.
/// @param images  with clamped fireflies
RgbImage upper_bounds(const GradientImages& images, const FeatureKernels& kernels,
                      const GuidedParameters& parameters, const ParallelFor& parallel_for);

} // namespace tessera
