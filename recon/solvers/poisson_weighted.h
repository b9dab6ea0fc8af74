#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/solvers/poisson_problem.h"
#include "recon/solvers/weighted_multigrid.h"

#include <cstdint>

namespace tessera {

/// Weights of gradients in [0, 1]: x(x, y) of dx(x, y), y(x, y) of dy(x, y). The last column of x and the last row
/// of y are 0, where gradients are undefined.
struct EdgeWeights {
    Image<float> x, y;

    /// Returns weights of 1 for all gradients.
    static EdgeWeights ones(int width, int height) {
        EdgeWeights weights{Image<float>(width, height, 1), Image<float>(width, height, 1)};
        for (int y = 0; y < height; ++y)
            weights.x(width - 1, y) = 0;
        for (int x = 0; x < width; ++x)
            weights.y(x, height - 1) = 0;
        return weights;
    }

    /// Returns the bytes of both images.
    static std::uint64_t bytes(int width, int height) {
        return 2 * sizeof(float) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};

/// Numbers of conjugate gradient steps of a weighted solve.
struct WeightedSettings {
    int cold_iterations = 5; ///< without a last correction
    int warm_iterations = 3; ///< from the last correction
};

/// The screened Poisson problem with a weight for each gradient, reconstruction (37): minimises the sum over the
/// pixels of
///     w_x |Dx I - dx|^2 + w_y |Dy I - dy|^2 + (alpha |I - primal|)^2 .
/// The normal equations are A I = b with A = alpha^2 + Dx^T w_x Dx + Dy^T w_y Dy. Every column of A sums to
/// alpha^2, so that the image has the mean of the primal, whatever the weights.
///
/// The method is conjugate gradients [Hestenes and Stiefel 1952], preconditioned by multigrid for the same
/// weights, in the form of [Chronopoulos and Gear 1989]. It starts from the primal. The correction of the last
/// solve is the first direction tried (a warm start). The default numbers of steps do not converge fully; smaller
/// alphas need more of them.
class WeightedSolver {
public:
    /// @param width, height  >= 1
    WeightedSolver(int width, int height);

    /// Returns the bytes of such a solver, used by so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Writes the solution to `image`, which must not be an image of the problem. Returns the number of steps, at
    /// least 1, or 0 if stopped between two steps. The result has the same bits for any parallel_for. Where
    /// numbers overflow, the result is the primal, or NaN if even the right side overflows.
    int solve(const PoissonProblem& problem, const EdgeWeights& weights, const WeightedSettings& settings,
              RgbImage& image, const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// Makes the next solve start cold, for data that differ from the last.
    void forget() { correction_ = {}; }

private:
    void make_room(const ParallelFor& parallel_for);
    bool try_last_correction(const PoissonProblem& problem, const EdgeWeights& weights,
                             const ParallelFor& parallel_for);
    int descend(const PoissonProblem& problem, const EdgeWeights& weights, int iterations,
                const ParallelFor& parallel_for, const SolveWatch& watch);
    void add_correction(const RgbImage& primal, RgbImage& image, const ParallelFor& parallel_for);

    int width_, height_;
    WeightedMultigrid multigrid_;
    RgbImage correction_;   ///< solution minus primal; empty: none
    RgbImage residual_;     ///< r = b - A I
    RgbImage solved_;       ///< z, the multigrid's solution for r
    RgbImage applied_;      ///< A z
    RgbImage direction_;    ///< p, direction of the step
    RgbImage applied_step_; ///< A p
};

} // namespace tessera
