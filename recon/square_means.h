#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

namespace tessera {

/// The mean over the square of edge 2 radius + 1 around each pixel, as far as something is measured there: not
/// beyond the image, and not in its last `columns` and `rows`, where the result is 0, too. Sums are made anew for
/// each pixel, so that no rounding is left behind a bright one.
Image<float> square_means(const Image<float>& values, int radius, int columns, int rows,
                          const ParallelFor& parallel_for);

/// Puts the same of numbers that are not negative in their place, at a cost that does not depend on the radius: by
/// running sums in double.
/// @param rows  of the same size: anything, and anything after
void take_wide_means(Image<float>& values, int radius, Image<float>& rows, const ParallelFor& parallel_for);

} // namespace tessera
