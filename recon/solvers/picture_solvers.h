#pragma once

#include "recon/solvers/component_solver.h"
#include "recon/solvers/poisson_direct.h"
#include "recon/solvers/poisson_l1.h"
#include "recon/solvers/poisson_weighted.h"

#include <cstdint>
#include <optional>

namespace tessera {

/// Accuracy and cost of a solve.
struct SolveStats {
    double residual = 0; ///< relative residual of the normal equations (L2)
    int iterations = 0;  ///< inner solves, steps of weighted, or sweeps of uniform; 1 for L2
};

/// Solvers for pictures of one size. Each is created when it is first needed, and starts from its last solution.
/// One call at a time. A stopped solve leaves an empty picture.
class PictureSolvers {
public:
    /// @param width, height  >= 1
    PictureSolvers(int width, int height) : width_(width), height_(height) {}

    int width() const { return width_; }
    int height() const { return height_; }

    /// Writes a reconstruction from raw samples, reconstruction (33) to (37), of primal and gradients or of the
    /// components of a basis. With a basis it is the coefficient.
    /// @param norm  l2, l1, mixed, uniform or weighted
    SolveStats solve(const GradientImages& images, Norm norm, float alpha, RgbImage& picture,
                     const ParallelFor& parallel_for, const SolveWatch& watch);

    /// Solves reconstruction (37) for given weights, and returns the number of steps.
    /// @param alpha     weighted_alpha()
    /// @param are_kept  the weights are those of the last picture, so that fewer steps suffice
    int solve_weighted(const GradientImages& images, float alpha, const EdgeWeights& weights, bool are_kept,
                       RgbImage& picture, const ParallelFor& parallel_for, const SolveWatch& watch);

    /// Solves the same problem for the half differences, to the accuracy that a measure of noise needs.
    void solve_halves(const GradientImages& images, float alpha, const EdgeWeights& weights, RgbImage& noise,
                      const ParallelFor& parallel_for, const SolveWatch& watch);

    /// Make the next solves start cold.
    void forget();
    void forget_halves();

    /// Returns the bytes that solving for a picture would newly allocate, on so many threads.
    std::uint64_t bytes_for(Norm norm, int threads, int components) const;

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
    std::optional<ComponentSolver> components_;
};

} // namespace tessera
