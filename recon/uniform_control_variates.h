#pragma once

#include "recon/poisson_problem.h"
#include "recon/solve_watch.h"

namespace tessera {

/// Uniform image-space control variates [Rousselle 2016]: each pixel's neighbours, with the gradients to it added,
/// are as many estimates of the pixel as there are, and it takes their mean with its own, again and again,
///     I <- I + (sum over neighbours n of I(n) + gradient from n - I) / 5 ,
/// beginning with the primal. That is a descent on the gradients' misfits, and stopping it takes the part of the
/// screened Poisson problem's alpha. A border stands for a neighbour like the pixel itself, so that no light is
/// lost.
///
/// Writes the answer to `image`, which is none of the problem's, whose alpha does not matter. Returns
/// `iterations`, or 0 if stopped, which is looked at between them.
int average_neighbours(const PoissonProblem& problem, int iterations, RgbImage& image,
                       const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
