#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/solvers/poisson_problem.h"
#include "recon/solvers/weighted_multigrid.h"

#include <cstdint>

namespace tessera {

/// How far gradients are to be trusted, in [0, 1]: x(x, y) is that of dx(x, y), y(x, y) that of dy(x, y). The last
/// column of x and the last row of y are 0, as nothing is measured there.
struct EdgeWeights {
    Image<float> x, y;

    /// Full trust in every gradient.
    static EdgeWeights ones(int width, int height) {
        EdgeWeights weights{Image<float>(width, height, 1), Image<float>(width, height, 1)};
        for (int y = 0; y < height; ++y)
            weights.x(width - 1, y) = 0;
        for (int x = 0; x < width; ++x)
            weights.y(x, height - 1) = 0;
        return weights;
    }

    /// The memory that they take.
    static std::uint64_t bytes(int width, int height) {
        return 2 * sizeof(float) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};

/// How long a weighted solve takes.
struct WeightedSettings {
    int cold_iterations = 5; ///< steps of a first solve
    int warm_iterations = 3; ///< of one that has the last correction
};

/// The screened Poisson problem with a weight for each gradient: minimises the sum over the pixels of
///     w_x |Dx I - dx|^2 + w_y |Dy I - dy|^2 + (alpha |I - primal|)^2 .
/// The normal equations are A I = b with A = alpha^2 + Dx^T w_x Dx + Dy^T w_y Dy. Every column of A sums to
/// alpha^2, so that the image has the mean of the primal, whatever the weights.
///
/// Conjugate gradients [Hestenes and Stiefel 1952], preconditioned by multigrid for the same weights, in the form
/// that needs all its sums at one time [Chronopoulos and Gear 1989]. The start is the primal; what the last solve
/// has added to it is the first direction tried (a warm start). For alpha from 0.06 up (that of tiles of 6
/// pixels, weighted_alpha) the default iterations come so near that relMSE is a percent or two from the optimum's,
/// at edges of lamps up to five; a smaller one would take more.
class WeightedSolver {
public:
    /// `width` and `height` are >= 1.
    WeightedSolver(int width, int height);

    /// The memory that such a solver takes, if it works on so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Writes the answer to `image`, which is none of the problem's; returns the number of steps, 1 at least, 0 if
    /// stopped, which is looked at between them. The same bits for any parallel_for. Where numbers are too large
    /// for floats, the answer is the primal, and no number where not even the right side can be told.
    int solve(const PoissonProblem& problem, const EdgeWeights& weights, const WeightedSettings& settings,
              RgbImage& image, const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// The next solve starts from nothing: right for data unlike the last.
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
    RgbImage correction_;   ///< the answer without the start; empty: there is none
    RgbImage residual_;     ///< r = b - A I
    RgbImage solved_;       ///< z, the multigrid's answer to r
    RgbImage applied_;      ///< A z
    RgbImage direction_;    ///< of the step, p
    RgbImage applied_step_; ///< A p
};

} // namespace tessera
