#include "recon/solvers/picture_solvers.h"

#include "recon/solvers/edge_weights.h"

namespace tessera {

namespace {

constexpr int uniform_iterations = 50;

// Fireflies of raw samples make weights jump at the borders of tiles, which slows convergence.
constexpr WeightedSettings of_raw_samples{.cold_iterations = 20, .warm_iterations = 10};
// With kept weights, the last correction is nearly the solution.
constexpr WeightedSettings by_kept_weights{.warm_iterations = 2};
// The half differences are one sample of the noise; two steps are more accurate than that sample.
constexpr WeightedSettings of_halves{.cold_iterations = 2, .warm_iterations = 2};

} // namespace

SolveStats PictureSolvers::solve(const GradientImages& images, Norm norm, float alpha, RgbImage& picture,
                                 const ParallelFor& parallel_for, const SolveWatch& watch) {
    if (norm == Norm::weighted)
        alpha = weighted_alpha(alpha, images.patch);
    const PoissonProblem problem{images.primal, images.dx, images.dy, alpha};
    SolveStats stats;
    if (images.components.empty())
        components_.reset();
    if (!images.components.empty() && reconstructs_components(norm)) {
        stats.iterations = made(components_).solve(images, norm, alpha, picture, parallel_for, watch);
    } else if (norm == Norm::l2) {
        made(l2_).solve(problem, picture, parallel_for);
        stats = {poisson_residual(problem, picture, parallel_for), 1};
    } else if (norm == Norm::uniform) {
        stats.iterations = average_neighbours(problem, uniform_iterations, picture, parallel_for, watch);
    } else if (norm == Norm::weighted) {
        const EdgeWeights weights = weights_of_gradients(images, alpha, {}, parallel_for);
        stats.iterations = made(weighted_).solve(problem, weights, of_raw_samples, picture, parallel_for, watch);
    } else {
        const L1Settings l1{.square_primal = norm == Norm::mixed};
        stats.iterations = made(l1_).solve(problem, l1, picture, parallel_for, watch);
    }
    if (watch.is_stopped())
        picture = {};
    return stats;
}

int PictureSolvers::solve_weighted(const GradientImages& images, float alpha, const EdgeWeights& weights,
                                   bool are_kept, RgbImage& picture, const ParallelFor& parallel_for,
                                   const SolveWatch& watch) {
    const PoissonProblem problem{images.primal, images.dx, images.dy, alpha};
    return made(weighted_).solve(problem, weights, are_kept ? by_kept_weights : WeightedSettings(), picture,
                                 parallel_for, watch);
}

void PictureSolvers::solve_halves(const GradientImages& images, float alpha, const EdgeWeights& weights,
                                  RgbImage& noise, const ParallelFor& parallel_for, const SolveWatch& watch) {
    const PoissonProblem halves{images.halves.primal, images.halves.dx, images.halves.dy, alpha};
    made(halves_).solve(halves, weights, of_halves, noise, parallel_for, watch);
}

void PictureSolvers::forget() {
    if (l1_)
        l1_->forget();
    if (weighted_)
        weighted_->forget();
    forget_halves();
}

void PictureSolvers::forget_halves() {
    if (halves_)
        halves_->forget();
}

std::uint64_t PictureSolvers::bytes_for(Norm norm, int threads, int components) const {
    if (components > 0 && reconstructs_components(norm))
        return components_ && components_->components() >= components
                   ? 0
                   : ComponentSolver::bytes(width_, height_, components, threads);
    const std::uint64_t weighted = WeightedSolver::bytes(width_, height_, threads);
    switch (norm) {
    case Norm::l2:
        return l2_ ? 0 : PoissonSolver::bytes(width_, height_, threads);
    case Norm::l1:
    case Norm::mixed:
        return l1_ ? 0 : L1Solver::bytes(width_, height_, threads);
    case Norm::weighted:
        return weighted_ ? 0 : weighted;
    case Norm::guided:
        return (weighted_ ? 0 : weighted) + (halves_ ? 0 : weighted);
    case Norm::none:
    case Norm::uniform:
    case Norm::smoothed:
    case Norm::oidn:
        break;
    }
    return 0;
}

} // namespace tessera
