#include "recon/solvers/component_solver.h"

#include "recon/solvers/edge_weights.h"
#include "recon/solvers/poisson_l1.h"
#include "recon/solvers/weighted_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

constexpr int linear_iterations = 48, weighted_iterations = 16;
constexpr int reweightings = 8, reweighted_iterations = 6;
constexpr float least_length = 0.1f; ///< in typical values; shorter misfits have the weight of L2

// Least alpha of start and preconditioner: they need not have the problem's alpha, and a smaller one would need
// refinement.
constexpr float least_alpha = 0.1f;

EdgeWeights all_of(float weight, int width, int height) {
    EdgeWeights weights{Image<float>(width, height, weight), Image<float>(width, height, weight)};
    for (int y = 0; y < height; ++y)
        weights.x(width - 1, y) = 0;
    for (int x = 0; x < width; ++x)
        weights.y(x, height - 1) = 0;
    return weights;
}

/// Returns V of write_row(): `image` times the numbers of `scale`.
auto scaled_by(const Image<float>& scale, const RgbImage& image) {
    return [&scale, &image](int x, int row, int count, float* out) {
        const float *own = values(image, x, row), *s = scale.row(row) + x;
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c)
                out[3 * i + c] = s[i] * own[3 * i + c];
    };
}

} // namespace

std::uint64_t ComponentSolver::bytes(int width, int height, int components, int threads) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    return PoissonSolver::bytes(width, height, threads) +
           pixels * (static_cast<std::uint64_t>(components) * (6 * sizeof(Rgb) + 2 * sizeof(float)) +
                     2 * sizeof(Rgb) + 2 * sizeof(float));
}

void ComponentSolver::make_room(int components) {
    const int width = solver_.width(), height = solver_.height();
    components_.resize(static_cast<std::size_t>(components));
    for (Component& component : components_)
        for (RgbImage* kept :
             {&component.residual, &component.applied, &component.direction, &component.applied_step})
            if (kept->empty())
                *kept = RgbImage(width, height);
    for (RgbImage* kept : {&sum_, &of_whole_})
        if (kept->empty())
            *kept = RgbImage(width, height);
}

/// Solves for each component by itself.
void ComponentSolver::start(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    for (std::size_t l = 0; l < components_.size(); ++l) {
        const BasisComponent& given = images.components[l];
        solver_.solve(PoissonProblem{given.primal, given.dx, given.dy, std::max(alpha, least_alpha)},
                      components_[l].image, parallel_for);
    }
}

/// Sets weights from each component's variances against those of the primal of the whole, which the primal's term
/// contains.
void ComponentSolver::weigh(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    for (std::size_t l = 0; l < components_.size(); ++l)
        components_[l].weights = weights_of_component(images, images.components[l], alpha, parallel_for);
    whole_ = weights_of_gradients(images, alpha, {}, parallel_for);
}

/// Sets weights by which the weighted squares approximate unit times the lengths (iteratively reweighted least
/// squares).
void ComponentSolver::reweigh(const GradientImages& images, float unit, const ParallelFor& parallel_for) {
    const int width = solver_.width(), height = solver_.height();
    const auto weight = [&](Rgb misfit) {
        return unit / (2 * std::max(glm::length(misfit), least_length * unit));
    };
    parallel_for(height, [&](int y) {
        for (std::size_t l = 0; l < components_.size(); ++l) {
            const BasisComponent& given = images.components[l];
            Component& component = components_[l];
            const RgbImage& e = component.image;
            for (int x = 0; x + 1 < width; ++x)
                component.weights.x(x, y) = weight(given.dx(x, y) - (e(x + 1, y) - e(x, y)));
            for (int x = 0; y + 1 < height && x < width; ++x)
                component.weights.y(x, y) = weight(given.dy(x, y) - (e(x, y + 1) - e(x, y)));
        }
    });
}

/// Sets sum_ to the sum over l of s^l times the component's `summand`.
void ComponentSolver::sum(const GradientImages& images, RgbImage Component::* summand,
                          const ParallelFor& parallel_for) {
    parallel_for(solver_.height(), [&](int y) {
        std::fill_n(sum_.row(y), sum_.width(), Rgb(0));
        for (std::size_t l = 0; l < components_.size(); ++l) {
            const float* s = images.components[l].projection.row(y);
            const Rgb* own = (components_[l].*summand).row(y);
            for (int x = 0; x < sum_.width(); ++x)
                sum_(x, y) += s[x] * own[x];
        }
    });
}

/// Sets r = b - A E of all components.
void ComponentSolver::find_residual(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    const int next_row = 3 * solver_.width();
    const float weight = alpha * alpha;
    sum(images, &Component::image, parallel_for);
    parallel_for(solver_.height(), [&](int y) {
        const auto misfit = [&](int x, int row, int count, float* out) {
            const float *given = values(images.primal, x, row), *own = values(sum_, x, row);
            for (int i = 0; i < 3 * count; ++i)
                out[i] = weight * (given[i] - own[i]);
        };
        if (whole_.x.empty())
            misfit(0, y, solver_.width(), values(of_whole_, 0, y));
        else
            write_row(whole_, y, misfit, misfits(images.dx, sum_, 3), misfits(images.dy, sum_, next_row),
                      values(of_whole_, 0, y));
        for (std::size_t l = 0; l < components_.size(); ++l) {
            const BasisComponent& given = images.components[l];
            Component& component = components_[l];
            write_row(component.weights, y, scaled_by(given.projection, of_whole_),
                      misfits(given.dx, component.image, 3), misfits(given.dy, component.image, next_row),
                      values(component.residual, 0, y));
        }
    });
}

/// Takes steps of conjugate gradients from the current residual. Returns false if stopped.
bool ComponentSolver::descend(const GradientImages& images, float alpha, int iterations,
                              const ParallelFor& parallel_for, const SolveWatch& watch) {
    const int width = solver_.width(), height = solver_.height(), next_row = 3 * width;
    const float weight = alpha * alpha;
    StepFactors factors;
    for (int i = 0; i < iterations; ++i) {
        if (!watch.goes_on(done_++, all_))
            return false;
        for (Component& component : components_)
            solver_.solve(component.residual, std::max(alpha, least_alpha), component.solved, parallel_for);
        sum(images, &Component::solved, parallel_for);
        std::vector<Channels> rows_rz(static_cast<std::size_t>(height)), rows_wz(rows_rz);
        parallel_for(height, [&](int y) {
            const auto own = [&](int x, int row, int count, float* out) {
                const float* z = values(sum_, x, row);
                for (int j = 0; j < 3 * count; ++j)
                    out[j] = weight * z[j];
            };
            if (whole_.x.empty())
                own(0, y, width, values(of_whole_, 0, y));
            else
                write_row(whole_, y, own, differences(sum_, 3), differences(sum_, next_row),
                          values(of_whole_, 0, y));
            Channels &rz = rows_rz[static_cast<std::size_t>(y)], &wz = rows_wz[static_cast<std::size_t>(y)];
            for (std::size_t l = 0; l < components_.size(); ++l) {
                Component& component = components_[l];
                write_row(component.weights, y, scaled_by(images.components[l].projection, of_whole_),
                          differences(component.solved, 3), differences(component.solved, next_row),
                          values(component.applied, 0, y));
                const Channels a =
                    products(values(component.residual, 0, y), values(component.solved, 0, y), width);
                const Channels b =
                    products(values(component.applied, 0, y), values(component.solved, 0, y), width);
                for (int c = 0; c < 3; ++c) {
                    rz[c] += a[c];
                    wz[c] += b[c];
                }
            }
        });
        const Channels rz = total(rows_rz), wz = total(rows_wz);
        if (!std::isfinite(total(rz) + total(wz)))
            return true; // overflow: keeps the current image
        factors.take(rz, wz);
        const Factors turns = factors.turns(), steps = factors.steps();
        parallel_for(height, [&](int y) {
            for (Component& component : components_)
                take_step(turns, steps, width, values(component.solved, 0, y), values(component.applied, 0, y),
                          values(component.direction, 0, y), values(component.applied_step, 0, y),
                          values(component.image, 0, y), values(component.residual, 0, y));
        });
    }
    return true;
}

int ComponentSolver::solve(const GradientImages& images, Norm norm, float alpha, RgbImage& image,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    const int width = solver_.width(), height = solver_.height();
    const bool is_reweighted = norm == Norm::l1 || norm == Norm::mixed;
    const int rounds = is_reweighted ? reweightings : 1;
    const int iterations = is_reweighted            ? reweighted_iterations
                           : norm == Norm::weighted ? weighted_iterations
                                                    : linear_iterations;
    done_ = 0;
    all_ = rounds * iterations;
    make_room(static_cast<int>(images.components.size()));
    start(images, alpha, parallel_for);
    whole_ = {};
    for (Component& component : components_)
        component.weights = all_of(1, width, height);
    if (norm == Norm::weighted)
        weigh(images, alpha, parallel_for);
    for (int round = 0; round < rounds; ++round) {
        if (is_reweighted)
            reweigh(images, typical_value(images.primal), parallel_for);
        find_residual(images, alpha, parallel_for);
        if (!descend(images, alpha, iterations, parallel_for, watch))
            return 0;
    }
    sum(images, &Component::image, parallel_for);
    image = sum_;
    return done_ + 1;
}

} // namespace tessera
