#pragma once

#include "recon/poisson_direct.h"

#include <stop_token>

namespace tessera {

/// As the screened Poisson problem, with absolute values for squares: minimises the sum over the pixels of
///     |Dx I - dx| + |Dy I - dy| + alpha |I - primal| ,
/// where |.| is the length of a colour, so that the channels agree on what is an outlier. `solver` must be of the
/// problem's size. Writes the answer to `image`; returns the number of inner solves, 0 if stopped, which is looked
/// at between them. Outliers of hundreds of typical values and more would take more iterations to vanish.
int solve_poisson_l1(const PoissonProblem& problem, PoissonSolver& solver, RgbImage& image,
                     const ParallelFor& parallel_for, std::stop_token stop, int iterations = 30);

} // namespace tessera
