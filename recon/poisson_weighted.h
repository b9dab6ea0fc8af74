#pragma once

#include "recon/edge_weights.h"
#include "recon/poisson_direct.h"

#include <stop_token>

namespace tessera {

/// When a weighted solve ends.
struct WeightedSettings {
    float tolerance = 3e-3f; ///< of the error's energy norm, against that of the whole image
    int iterations = 20;     ///< at most
};

/// The screened Poisson problem with a weight for each gradient: minimises the sum over the pixels of
///     w_x |Dx I - dx|^2 + w_y |Dy I - dy|^2 + (alpha |I - primal|)^2 .
/// The normal equations are A I = b with A = alpha^2 + Dx^T w_x Dx + Dy^T w_y Dy. Every column of A sums to
/// alpha^2, so that the image has the mean of the primal, whatever the weights.
///
/// Conjugate gradients [Hestenes and Stiefel 1952], preconditioned by the direct solver for weights of 1
/// [Concus and Golub 1973], in the form that needs all its sums at one time [Chronopoulos and Gear 1989]. As
/// weights lie in [0, 1] and most are near 1, about eight steps do.
class WeightedSolver {
public:
    /// Both >= 1.
    WeightedSolver(int width, int height);

    /// Writes the answer to `image`, which is none of the problem's; returns the number of inner solves, 0 if
    /// stopped, which is looked at between them. Begins with what is in `image` if it is of this size and
    /// `is_warm`. The same bits for any parallel_for.
    int solve(const PoissonProblem& problem, const EdgeWeights& weights, const WeightedSettings& settings,
              bool is_warm, RgbImage& image, const ParallelFor& parallel_for = serial_for,
              std::stop_token stop = {});

private:
    PoissonSolver solver_;
    RgbImage residual_;     ///< r = b - A I
    RgbImage solved_;       ///< z, the direct solver's answer to r
    RgbImage applied_;      ///< A z
    RgbImage direction_;    ///< of the step, p
    RgbImage applied_step_; ///< A p
};

} // namespace tessera
