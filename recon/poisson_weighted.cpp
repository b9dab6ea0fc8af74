#include "recon/poisson_weighted.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"
#include "recon/weighted_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

// The best of what was tried on Veach, Ajar, Country Kitchen, Bathroom and The Grey & White Room, G-PR, 4 and 15
// samples a pixel. A larger k leaves the noise of rare paths.
constexpr float noise_factor = 0.7f; // k
constexpr int gradient_radius = 1, primal_radius = 2;
constexpr float gradient_share = 0.5f, primal_share = 0.2f; // of the own variance against the mean around

constexpr float largest_variance = 1e30f; // sums of some dozens stay finite
// Of the mean brightness, what every pixel has besides its own: as much as the smoothing by guides gives it.
constexpr float dark = 0.2f;

/// Variances where nobody has measured them, from how much the values differ in the square of 3x3 pixels around
/// each: the sample variance, summed over the channels. What the picture itself varies by counts as noise. Like
/// those that are measured, they are 0 in the last `columns` and `rows`.
Image<float> variances_from_neighbours(const RgbImage& values, int columns, int rows,
                                       const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> variances(values.width(), values.height());
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            double squares = 0, n = 0;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i, ++n) {
                    const glm::dvec3 value(values(i, j));
                    sum += value;
                    squares += glm::dot(value, value);
                }
            const double spread = squares - glm::dot(sum, sum) / n; // below 0 by rounding alone
            if (n > 1)
                variances(x, y) = static_cast<float>(std::clamp(spread / (n - 1), 0.0, double(largest_variance)));
        }
    });
    return variances;
}

/// How bright pixels are, beside which variances are looked at.
struct Brightness {
    float mean = 1;                         ///< of the picture; 1: all count as equally bright
    float most_relative = largest_variance; ///< no variance over the squares is more
    Image<float> squares;                   ///< of brightness over the mean, and a little

    /// @param is_known  false: of one sample, which is dark by chance where others are bright
    Brightness(const RgbImage& primal, bool is_known, const ParallelFor& parallel_for)
        : squares(primal.width(), primal.height(), Unfilled()) {
        constexpr float largest = 1e4f; // squares stay finite
        const auto brightness = [&](std::size_t i) {
            const Rgb c = primal.data()[i];
            return std::max((c.r + c.g + c.b) / 3, 0.0f);
        };
        const double sum = sum_over_pixels(primal.width(), primal.height(), parallel_for, brightness);
        const auto mean_of_all = static_cast<float>(sum / static_cast<double>(primal.size()));
        const bool is_lit = is_known && mean_of_all > 0 && std::isfinite(mean_of_all);
        if (is_lit) {
            mean = mean_of_all;
            // Of a mean to which one sample has brought all, the sum over the channels of a grey. Beyond it are
            // pixels whose spikes are held back while their variances are not.
            most_relative = 3;
        }
        for_pixels(primal.width(), primal.height(), parallel_for, [&](std::size_t i) {
            const float b = is_lit ? std::min(brightness(i) / mean, largest) + dark : 1;
            squares.data()[i] = b * b;
        });
    }
};

/// Each variance over the square of the brightness, blended with the mean over the square of edge 2 radius + 1
/// around its pixel, as far as something is measured there, and times that square again: not in the last `columns`
/// and `rows`, where the result is 0, too. Squares are summed over the pixels that a variance is of. The results
/// are in units of the mean's square.
Image<float> blended(const Image<float>& variances, const Brightness& brightness, float own_share, int radius,
                     int columns, int rows, const ParallelFor& parallel_for) {
    const int width = variances.width() - columns, height = variances.height() - rows;
    const Image<float>& squares = brightness.squares;
    const auto scale = [&](int x, int y) {
        return squares(x, y) + (columns + rows > 0 ? squares(x + columns, y + rows) : 0.0f);
    };
    Image<float> own(variances.width(), variances.height(), Unfilled());
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const float variance = std::min(variances(x, y), largest_variance) / brightness.mean / brightness.mean;
            own(x, y) = std::min(variance / scale(x, y), brightness.most_relative);
        }
    });
    Image<float> blend = square_means(own, radius, columns, rows, parallel_for);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            blend(x, y) = (own_share * own(x, y) + (1 - own_share) * blend(x, y)) * scale(x, y);
    });
    return blend;
}

/// The weight of a gradient between two pixels. Where one has far less noise than the other, as a dark pixel
/// beside a lamp's edge, it needs the gradient least, and would take the other's noise: what counts is the
/// geometric mean.
float weight(float alpha, float gradient_variance, float one_primal_variance, float other_primal_variance) {
    const float primal_variance = std::sqrt(one_primal_variance) * std::sqrt(other_primal_variance);
    const float least = alpha * alpha * primal_variance, noise = noise_factor * gradient_variance;
    return noise > 0 ? least / (least + noise) : 1;
}

/// What `gradients` (the whole's, or a part's) are to be trusted beside the whole's primal.
template <class Gradients>
EdgeWeights weights_of(const GradientImages& images, const Gradients& gradients, float alpha,
                       const ParallelFor& parallel_for) {
    const int width = images.primal.width(), height = images.primal.height();
    const bool is_measured = images.has_variances();
    const Brightness brightness(images.primal, is_measured, parallel_for);
    const auto noise = [&](const RgbImage& values, const Image<float>& measured, float own_share, int radius,
                           int columns, int rows) {
        const Image<float> around =
            is_measured ? Image<float>() : variances_from_neighbours(values, columns, rows, parallel_for);
        return blended(is_measured ? measured : around, brightness, own_share, radius, columns, rows,
                       parallel_for);
    };
    const Image<float> primal = noise(images.primal, images.primal_variance, primal_share, primal_radius, 0, 0);
    const Image<float> dx = noise(gradients.dx, gradients.dx_variance, gradient_share, gradient_radius, 1, 0);
    const Image<float> dy = noise(gradients.dy, gradients.dy_variance, gradient_share, gradient_radius, 0, 1);
    EdgeWeights weights{Image<float>(width, height), Image<float>(width, height)};
    parallel_for(height, [&](int y) {
        for (int x = 0; x + 1 < width; ++x)
            weights.x(x, y) = weight(alpha, dx(x, y), primal(x, y), primal(x + 1, y));
        if (y + 1 < height)
            for (int x = 0; x < width; ++x)
                weights.y(x, y) = weight(alpha, dy(x, y), primal(x, y), primal(x, y + 1));
    });
    return weights;
}

} // namespace

EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    return weights_of(images, images, alpha, parallel_for);
}

EdgeWeights weights_of_part(const GradientImages& images, const CoefficientPart& part, float alpha,
                            const ParallelFor& parallel_for) {
    return weights_of(images, part, alpha, parallel_for);
}

namespace {

constexpr double rounding = 1e-13; // of the squared error: the square of a float's

/// r = b - A I.
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

/// w = A z; returns r z and w z.
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

void WeightedSolver::make_room() {
    for (RgbImage* kept : {&residual_, &solved_, &applied_, &direction_, &applied_step_, &correction_})
        if (kept->empty())
            *kept = RgbImage(width_, height_);
}

/// Adds as much of the last correction as brings the answer nearest to the optimum: a line search in each channel.
/// False: there is nothing to be tried, as after a black image.
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

/// Adds steps to the correction; returns how many. What is not finite empties all that is kept.
int WeightedSolver::descend(const PoissonProblem& problem, const EdgeWeights& weights, int iterations,
                            const ParallelFor& parallel_for, const SolveWatch& watch) {
    Channels rz_before{}, step{};
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
            return i; // solved, as far as floats can tell
        Channels turn{};
        for (int c = 0; c < 3; ++c) {
            turn[c] = step[c] > 0 ? rz[c] / rz_before[c] : 0;
            const double curvature = wz[c] - (step[c] > 0 ? turn[c] * rz[c] / step[c] : 0);
            step[c] = rz[c] > 0 && curvature > 0 ? rz[c] / curvature : 0;
        }
        const Factors turns(turn), steps(step);
        parallel_for(height_, [&](int y) {
            take_step(turns, steps, width_, values(solved_, 0, y), values(applied_, 0, y),
                      values(direction_, 0, y), values(applied_step_, 0, y), values(correction_, 0, y),
                      values(residual_, 0, y));
        });
        rz_before = rz;
    }
    return iterations;
}

/// Adds the correction to the start, and to the correction what is missing of the primal's mean. A takes the same
/// colour in every pixel to alpha^2 times that, so that this much of the optimum is known exactly.
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
    make_room();
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
    else // numbers were too large, and if even the right side's were, that must not look like an answer
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] += 0.0f * residual_.data()[i];
    return std::max(steps, 1);
}

} // namespace tessera
