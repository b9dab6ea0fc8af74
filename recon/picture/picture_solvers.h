#pragma once

#include "recon/picture/parts.h"
#include "recon/picture/reconstruct.h"
#include "recon/poisson_direct.h"
#include "recon/poisson_l1.h"
#include "recon/poisson_weighted.h"

#include <cstdint>
#include <optional>

namespace tessera {

/// The solvers of pictures of one size: each is made when it is first asked for, and goes on from where it last
/// stood. One call at a time.
class PictureSolvers {
public:
    /// `width` and `height` are >= 1.
    PictureSolvers(int width, int height) : width_(width), height_(height) {}

    int width() const { return width_; }
    int height() const { return height_; }

    /// Whether a picture's gradients are weighed one by one, by weights_of_gradients().
    static bool weighs_gradients(const GradientImages& images, Norm norm);

    /// A picture as a norm makes it of primal and gradients, or parts: coefficients, where these are; without
    /// what comes after in reconstruct(). Its image is empty where it was stopped; it takes no time.
    /// @param weights   where gradients are weighed
    /// @param are_kept  they were those of the last picture, too: what is left to solve is less
    Reconstruction solve(const GradientImages& images, const ReconstructionSettings& settings,
                         const EdgeWeights& weights, bool are_kept, const ParallelFor& parallel_for,
                         const SolveWatch& watch);

    /// What weighted equations make of the halves' differences. Anything: stopped.
    RgbImage solve_halves(const GradientImages& images, float alpha, const EdgeWeights& weights,
                          const ParallelFor& parallel_for, const SolveWatch& watch);

    /// The next pictures start from nothing.
    void forget();
    void forget_halves();

    /// The memory of what is still to be made for such a picture, on so many threads.
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
    std::optional<PartsSolver> parts_;
};

} // namespace tessera
