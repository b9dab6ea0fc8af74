#include "recon/solvers/poisson_weighted.h"

#include "recon/pixel_loops.h"
#include "recon/solvers/weighted_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr double rounding = 1e-13; // relative squared error that floats can resolve

/// Sets r = b - A I.
void residual(const PoissonProblem& problem, const EdgeWeights& weights, const RgbImage& image, RgbImage& r,
              const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    const float weight = problem.alpha * problem.alpha;
    parallel_for(height, [&](int y) {
        const auto misfit = [&](int x, int row, int count, float* out) {
            const float *given = values(problem.primal, x, row), *own = values(image, x, row);
            for (int i = 0; i < 3 * count; ++i)
                out[i] = weight * (given[i] - own[i]);
        };
        write_row(weights, y, misfit, misfits(problem.dx, image, 3), misfits(problem.dy, image, 3 * width),
                  values(r, 0, y));
    });
}

/// Sets w = A z, and returns the scalar products r z and w z.
std::array<Channels, 2> apply(const EdgeWeights& weights, float alpha, const RgbImage& z, const RgbImage& r,
                              RgbImage& w, const ParallelFor& parallel_for) {
    const int width = z.width(), height = z.height();
    std::vector<Channels> rz(height), wz(height);
    parallel_for(height, [&](int y) {
        const auto scaled = [&z, weight = alpha * alpha](int x, int row, int count, float* out) {
            const float* own = values(z, x, row);
            for (int i = 0; i < 3 * count; ++i)
                out[i] = weight * own[i];
        };
        write_row(weights, y, scaled, differences(z, 3), differences(z, 3 * width), values(w, 0, y));
        rz[y] = products(values(r, 0, y), values(z, 0, y), width);
        wz[y] = products(values(w, 0, y), values(z, 0, y), width);
    });
    return {total(rz), total(wz)};
}

} // namespace

WeightedSolver::WeightedSolver(int width, int height)
    : width_(width), height_(height), multigrid_(width, height) {}

std::uint64_t WeightedSolver::bytes(int width, int height, int threads) {
    constexpr std::uint64_t images = 6; // its members
    return WeightedMultigrid::bytes(width, height, threads) +
           images * sizeof(Rgb) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

void WeightedSolver::make_room(const ParallelFor& parallel_for) {
    for (RgbImage* kept : {&residual_, &solved_, &applied_, &direction_, &applied_step_, &correction_})
        if (kept->empty())
            *kept = filled_image(width_, height_, Rgb(0), parallel_for);
}

/// Scales the last correction to the optimum along it, by a line search in each channel. Returns false if it is
/// zero, as after a black image.
bool WeightedSolver::try_last_correction(const PoissonProblem& problem, const EdgeWeights& weights,
                                         const ParallelFor& parallel_for) {
    const auto [rc, cc] = apply(weights, problem.alpha, correction_, residual_, applied_, parallel_for);
    Rgb length(0);
    for (int c = 0; c < 3; ++c)
        length[c] = cc[c] > 0 ? static_cast<float>(rc[c] / cc[c]) : 0;
    parallel_for(height_, [&](int y) {
        for (int x = 0; x < width_; ++x) {
            correction_(x, y) *= length;
            residual_(x, y) -= length * applied_(x, y);
        }
    });
    return total(cc) > 0;
}

/// Adds steps to the correction, and returns their number. Numbers that are not finite clear all kept images.
int WeightedSolver::descend(const PoissonProblem& problem, const EdgeWeights& weights, int iterations,
                            const ParallelFor& parallel_for, const SolveWatch& watch) {
    StepFactors factors;
    double first = 0;
    for (int i = 0; i < iterations; ++i) {
        if (!watch.goes_on(i, iterations))
            return i;
        multigrid_.apply(residual_, solved_, parallel_for);
        const auto [rz, wz] = apply(weights, problem.alpha, solved_, residual_, applied_, parallel_for);
        if (!std::isfinite(total(rz) + total(wz))) {
            correction_ = direction_ = applied_step_ = {};
            return i;
        }
        if (i == 0)
            first = total(rz);
        if (!(total(rz) > rounding * first))
            return i; // solved to the precision of floats
        factors.take(rz, wz);
        const Factors turns = factors.turns(), steps = factors.steps();
        parallel_for(height_, [&](int y) {
            take_step(turns, steps, width_, values(solved_, 0, y), values(applied_, 0, y),
                      values(direction_, 0, y), values(applied_step_, 0, y), values(correction_, 0, y),
                      values(residual_, 0, y));
        });
    }
    return iterations;
}

/// Shifts the correction so that the image keeps the primal's mean, and adds it to the image. A maps a constant
/// image to alpha^2 times that image, so that the mean of the solution is known exactly.
void WeightedSolver::add_correction(const RgbImage& primal, RgbImage& image, const ParallelFor& parallel_for) {
    std::vector<Channels> rows(primal.height());
    parallel_for(primal.height(), [&](int y) {
        for (int x = 0; x < primal.width(); ++x) {
            const glm::dvec3 reached = glm::dvec3(image(x, y)) + glm::dvec3(correction_(x, y));
            const glm::dvec3 missing = glm::dvec3(primal(x, y)) - reached;
            for (int c = 0; c < 3; ++c)
                rows[y][c] += missing[c];
        }
    });
    const Channels sum = total(rows);
    const Rgb mean = Rgb(sum[0], sum[1], sum[2]) / static_cast<float>(primal.size());
    parallel_for(primal.height(), [&](int y) {
        for (int x = 0; x < primal.width(); ++x) {
            correction_(x, y) += mean;
            image(x, y) += correction_(x, y);
        }
    });
}

int WeightedSolver::solve(const PoissonProblem& problem, const EdgeWeights& weights,
                          const WeightedSettings& settings, RgbImage& image, const ParallelFor& parallel_for,
                          const SolveWatch& watch) {
    const bool has_last = !correction_.empty();
    make_room(parallel_for);
    multigrid_.prepare(weights, problem.alpha, parallel_for);
    image = copy_of(problem.primal, parallel_for);
    residual(problem, weights, image, residual_, parallel_for);
    const bool is_warm = has_last && try_last_correction(problem, weights, parallel_for);
    const int steps = descend(problem, weights, is_warm ? settings.warm_iterations : settings.cold_iterations,
                              parallel_for, watch);
    if (watch.is_stopped()) {
        forget();
        return 0;
    }
    if (!correction_.empty())
        add_correction(problem.primal, image, parallel_for);
    else // numbers overflowed; a residual that is not finite makes the image NaN
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] += 0.0f * residual_.data()[i];
    return std::max(steps, 1);
}

} // namespace tessera
