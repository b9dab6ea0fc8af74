#include "recon/picture/picture_solvers.h"

#include "recon/picture/edge_weights.h"
#include "recon/pixel_loops.h"
#include "recon/poisson_problem.h"

namespace tessera {

namespace {

constexpr int uniform_iterations = 50;

// Of a picture that has the weights of the last one: its correction was solved for by these already.
constexpr WeightedSettings by_kept_weights{.warm_iterations = 2};
// Noise need not be known better than it is alike from one half to another.
constexpr WeightedSettings of_halves{.cold_iterations = 2, .warm_iterations = 2};

bool expands(const GradientImages& images, Norm norm) {
    return !images.parts.empty() && expands(norm);
}

} // namespace

bool PictureSolvers::weighs_gradients(const GradientImages& images, Norm norm) {
    return images.has_gradients() && !expands(images, norm) &&
           (norm == Norm::weighted || norm == Norm::guided || norm == Norm::oidn);
}

Reconstruction PictureSolvers::solve(const GradientImages& images, const ReconstructionSettings& settings,
                                     const EdgeWeights& weights, bool are_kept, const ParallelFor& parallel_for,
                                     const SolveWatch& watch) {
    const bool is_weighted = weighs_gradients(images, settings.norm) || settings.norm == Norm::weighted;
    const float alpha = is_weighted ? weighted_alpha(settings.alpha, images.patch) : settings.alpha;
    const PoissonProblem problem{images.primal, images.dx, images.dy, alpha};
    Reconstruction result;
    if (images.parts.empty())
        parts_.reset();
    if (expands(images, settings.norm)) {
        result.iterations = made(parts_).solve(images, settings.norm, alpha, result.image, parallel_for, watch);
        if (watch.is_stopped())
            result.image = {};
        return result;
    }
    switch (images.has_gradients() ? settings.norm : Norm::none) {
    case Norm::none:
    case Norm::smoothed:
        result.image = copy_of(images.primal, parallel_for);
        break;
    case Norm::l2:
        made(l2_).solve(problem, result.image, parallel_for);
        result.residual = poisson_residual(problem, result.image, parallel_for);
        result.iterations = 1;
        break;
    case Norm::l1:
    case Norm::mixed: {
        const L1Settings l1{.square_primal = settings.norm == Norm::mixed};
        result.iterations = made(l1_).solve(problem, l1, result.image, parallel_for, watch);
        break;
    }
    case Norm::uniform:
        result.iterations = average_neighbours(problem, uniform_iterations, result.image, parallel_for, watch);
        break;
    case Norm::weighted:
    case Norm::guided:
    case Norm::oidn:
        result.iterations = made(weighted_).solve(
            problem, weights, are_kept ? by_kept_weights : WeightedSettings(), result.image, parallel_for, watch);
        break;
    }
    if (watch.is_stopped())
        result.image = {};
    return result;
}

RgbImage PictureSolvers::solve_halves(const GradientImages& images, float alpha, const EdgeWeights& weights,
                                      const ParallelFor& parallel_for, const SolveWatch& watch) {
    const PoissonProblem halves{images.halves.primal, images.halves.dx, images.halves.dy,
                                weighted_alpha(alpha, images.patch)};
    RgbImage noise;
    made(halves_).solve(halves, weights, of_halves, noise, parallel_for, watch);
    return noise;
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

std::uint64_t PictureSolvers::bytes_for(Norm norm, int threads, int parts) const {
    if (parts > 0 && expands(norm))
        return parts_ && parts_->parts() >= parts ? 0 : PartsSolver::bytes(width_, height_, parts, threads);
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
    case Norm::oidn:
        return (weighted_ ? 0 : weighted) + (halves_ ? 0 : weighted);
    case Norm::none:
    case Norm::uniform:
    case Norm::smoothed:
        break;
    }
    return 0;
}

} // namespace tessera
