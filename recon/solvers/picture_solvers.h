#pragma once

#include "recon/solvers/component_solver.h"
#include "recon/solvers/poisson_direct.h"
#include "recon/solvers/poisson_l1.h"
#include "recon/solvers/poisson_weighted.h"

#include <cstdint>
#include <optional>

namespace tessera {

/// How well a linear system was solved.
struct SolveStats {
    double residual = 0; ///< relative residual of the normal equations (L2)
    int iterations = 0;  ///< inner solves, steps of weighted, or sweeps of uniform; 1 for L2
};

/// The solvers for pictures of one size. Each is made when it is first needed, and starts from its last solution.
/// One call at a time. A picture is left empty where it was stopped.
class PictureSolvers {
public:
    /// `width` and `height` are >= 1.
    PictureSolvers(int width, int height) : width_(width), height_(height) {}

    int width() const { return width_; }
    int height() const { return height_; }

    /// Writes the published reconstruction of primal and gradients, or of the components of a basis, on raw
    /// samples: of the coefficient, where there is one.
    /// @param norm  l2, l1, mixed, uniform or weighted
    SolveStats solve(const GradientImages& images, Norm norm, float alpha, RgbImage& picture,
                     const ParallelFor& parallel_for, const SolveWatch& watch);

    /// Solves the weighted problem; returns the number of steps.
    /// @param alpha     weighted_alpha()
    /// @param are_kept  the weights are those of the last picture: fewer steps suffice
    int solve_weighted(const GradientImages& images, float alpha, const EdgeWeights& weights, bool are_kept,
                       RgbImage& picture, const ParallelFor& parallel_for, const SolveWatch& watch);

    /// Solves it for the half differences, as far as their size matters.
    void solve_halves(const GradientImages& images, float alpha, const EdgeWeights& weights, RgbImage& noise,
                      const ParallelFor& parallel_for, const SolveWatch& watch);

    /// The next pictures start from nothing.
    void forget();
    void forget_halves();

    /// Bytes that a picture still has to take, on so many threads.
    std::uint64_t bytes_for(Norm norm, int threads, int parts) const;

private:
    template <class Solver>
    Solver& made(std::optional<Solver>& solver) {
        if (!solver)
            solver.emplace(width_, height_);
        return *solver;
    }

    int width_, height_;
    std::optional<PoissonSolver> l2_;
    std::optional<L1Solver> l1_;
    std::optional<WeightedSolver> weighted_, halves_;
    std::optional<ComponentSolver> parts_;
};

} // namespace tessera
