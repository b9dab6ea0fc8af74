#include "recon/solvers/poisson_l1.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr int band_rows = 16;
constexpr int chunk_pixels = 64; // pixels processed at a time: their arrays stay in the L1 cache
constexpr int chunk_values = 3 * chunk_pixels;

// Thresholds t in units of typical_value(). A high one moves far per iteration; falling ones settle in the end.
// A factor of 2 in any of them costs a few iterations.
constexpr float first_threshold = 0.5f, warm_threshold = 0.05f, least_threshold = 0.1f, decay = 0.9f;
constexpr float settling_decay = 0.6f;
constexpr int settling_iterations = 6;
constexpr float over_relaxation = 1.7f; // [Boyd et al. 2011, 3.4.3]: 1.5 to 1.8

// Least beta: inner problems need not have the problem's alpha, and a smaller one would need refinement.
constexpr float least_beta = 0.1f;

float* values(RgbImage& image, int y) {
    return &image.row(y)->x;
}

const float* values(const RgbImage& image, int y) {
    return &image.row(y)->x;
}

/// How a term clamps w = q - g to the dual variable u.
enum class Cut { joint, scale };

/// Writes factors with u = factors[i] w[i], for `count` pixels.
void cut_factors(Cut cut, float threshold, int count, const float* w, float* factors) {
    switch (cut) {
    case Cut::joint: {
        // The second of three loops has all square roots, and vectorises.
        float length[chunk_pixels];
        for (int i = 0; i < count; ++i)
            length[i] = w[3 * i] * w[3 * i] + w[3 * i + 1] * w[3 * i + 1] + w[3 * i + 2] * w[3 * i + 2];
        for (int i = 0; i < count; ++i)
            length[i] = threshold / std::max(std::sqrt(length[i]), threshold);
        for (int i = 0; i < count; ++i)
            factors[3 * i] = factors[3 * i + 1] = factors[3 * i + 2] = length[i];
        return;
    }
    case Cut::scale:
        std::fill(factors, factors + 3 * count, threshold);
        return;
    }
}

} // namespace

/// Parameters of an iteration that are the same for all pixels.
struct L1Solver::Step {
    float relaxation; ///< 0: q stays, and only the right side is set up
    float resume;     ///< 1: q is stored as q - g, from the last solve; g is added first
    float park;       ///< 1: q is stored as q - g for the next solve
    float beta;
    float old_dual_scale;  ///< ratio of this threshold to the last, which scales u
    float next_dual_scale; ///< the same ratio in the next iteration
    Cut primal_cut;
    float old_threshold, threshold;               ///< last and current t of the gradients
    float old_primal_threshold, primal_threshold; ///< the same of the primal
};

namespace {

/// Updates one term at `count` pixels: replaces q by that for K I, and writes d - u, the target of the next inner
/// solve.
struct TermUpdate {
    Cut cut;
    float old_threshold, threshold;
    float relaxation, resume, park, old_dual_scale, next_dual_scale;

    void operator()(int count, const float* given, const float* now, float* q, float* target) const {
        float w[chunk_values], factors[chunk_values];
        for (int i = 0; i < 3 * count; ++i) {
            q[i] += resume * given[i];
            w[i] = q[i] - given[i];
        }
        cut_factors(cut, old_threshold, count, w, factors);
        for (int i = 0; i < 3 * count; ++i) {
            const float u = w[i] * factors[i];
            q[i] = relaxation * now[i] + (1 - relaxation) * (q[i] - u) + old_dual_scale * u;
            w[i] = q[i] - given[i];
        }
        cut_factors(cut, threshold, count, w, factors);
        for (int i = 0; i < 3 * count; ++i) {
            target[i] = q[i] - (1 + next_dual_scale) * factors[i] * w[i];
            q[i] -= park * given[i];
        }
    }
};

} // namespace

float typical_value(const RgbImage& image) {
    const std::size_t step = std::max<std::size_t>(image.size() / 4096, 1);
    std::vector<float> found;
    found.reserve(image.size() / step + 1);
    for (std::size_t i = 0; i < image.size(); i += step) {
        const Rgb c = glm::abs(image.data()[i]);
        const float value = std::max({c.r, c.g, c.b});
        if (value > 0)
            found.push_back(value);
    }
    if (found.empty())
        return 1;
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    return *middle;
}

L1Solver::L1Solver(int width, int height) : solver_(width, height) {}

std::uint64_t L1Solver::bytes(int width, int height, int threads) {
    constexpr std::uint64_t images = 4; // its members, without borders_
    const auto rows = static_cast<std::uint64_t>(height);
    return PoissonSolver::bytes(width, height, threads) +
           sizeof(Rgb) * static_cast<std::uint64_t>(width) * (images * rows + (rows + band_rows - 1) / band_rows);
}

int L1Solver::solve(const PoissonProblem& problem, const L1Settings& settings, RgbImage& image,
                    const ParallelFor& parallel_for, const SolveWatch& watch) {
    const float scale = typical_value(problem.primal);
    const bool warm = threshold_ > 0;
    if (!warm)
        start(problem, scale, image, parallel_for);
    else if (image.width() != solver_.width() || image.height() != solver_.height())
        image = RgbImage(solver_.width(), solver_.height());

    Step step{};
    step.beta = std::max(problem.alpha, least_beta);
    step.primal_cut = settings.square_primal ? Cut::scale : Cut::joint;
    const float pull = problem.alpha / (step.beta * step.beta);
    const auto primal_threshold = [&](float t) {
        const float squared = 2 * problem.alpha * pull * t;
        return settings.square_primal ? squared / (squared + scale) : pull * t;
    };
    const int iterations = warm ? settings.warm_iterations : settings.cold_iterations;
    float threshold = (warm ? warm_threshold : first_threshold) * scale;
    float last = warm ? threshold_ : threshold;
    threshold_ = 0; // a stopped solve leaves q invalid
    for (int i = 0; i < iterations; ++i) {
        if (!watch.goes_on(i, iterations))
            return 0;
        const bool settling = i + settling_iterations >= iterations;
        const float next =
            settling ? settling_decay * threshold : std::max(threshold * decay, least_threshold * scale);
        step.relaxation = i == 0 ? 0 : over_relaxation;
        step.resume = warm && i == 0 ? 1 : 0;
        step.park = i + 1 == iterations ? 1 : 0;
        step.old_dual_scale = threshold / last;
        step.next_dual_scale = next / threshold;
        step.old_threshold = last;
        step.threshold = threshold;
        step.old_primal_threshold = primal_threshold(last);
        step.primal_threshold = primal_threshold(threshold);
        iterate(problem, step, image, parallel_for);
        last = threshold;
        threshold = next;
    }
    threshold_ = last;
    return iterations;
}

// Starts from the data with outliers clamped, since a least squares solution would spread them. Pixels are clamped
// to what their neighbours and the gradients predict, give or take some typical values; then gradients to the
// pixels' differences.
void L1Solver::start(const PoissonProblem& problem, float scale, RgbImage& image,
                     const ParallelFor& parallel_for) {
    const int width = solver_.width(), height = solver_.height();
    for (RgbImage* kept : {&primal_, &dx_, &dy_, &right_side_, &image})
        if (kept->width() != width || kept->height() != height)
            *kept = RgbImage(width, height);
    borders_ = RgbImage(width, (height + band_rows - 1) / band_rows);
    constexpr float tolerance = 5;
    const Rgb margin(tolerance * scale);
    parallel_for(height, [&](int y) {
        const auto& [primal, dx, dy, alpha] = problem;
        for (int x = 0; x < width; ++x) {
            Rgb low(INFINITY), high(-INFINITY);
            const auto estimate = [&](Rgb value) {
                low = glm::min(low, value);
                high = glm::max(high, value);
            };
            if (x > 0)
                estimate(primal(x - 1, y) + dx(x - 1, y));
            if (x + 1 < width)
                estimate(primal(x + 1, y) - dx(x, y));
            if (y > 0)
                estimate(primal(x, y - 1) + dy(x, y - 1));
            if (y + 1 < height)
                estimate(primal(x, y + 1) - dy(x, y));
            const bool alone = width * height == 1;
            primal_(x, y) = alone ? primal(x, y) : glm::clamp(primal(x, y), low - margin, high + margin);
        }
    });
    parallel_for(height, [&](int y) {
        const auto cut = [&](Rgb gradient, Rgb difference) {
            return glm::clamp(gradient, difference - margin, difference + margin);
        };
        for (int x = 0; x < width; ++x) {
            const Rgb own = primal_(x, y);
            if (x + 1 < width)
                dx_(x, y) = cut(problem.dx(x, y), primal_(x + 1, y) - own);
            if (y + 1 < height)
                dy_(x, y) = cut(problem.dy(x, y), primal_(x, y + 1) - own);
        }
    });
}

/// Performs one iteration: a pass over the images, and an inner solve.
void L1Solver::iterate(const PoissonProblem& problem, const Step& step, RgbImage& image,
                       const ParallelFor& parallel_for) {
    const int bands = borders_.height(), row_values = 3 * solver_.width();
    parallel_for(bands, [&](int band) { update_band(problem, step, image, band); });
    for (int band = 1; band < bands; ++band) {
        float* first = values(right_side_, band * band_rows);
        const float* border = values(borders_, band - 1);
        for (int i = 0; i < row_values; ++i)
            first[i] += border[i];
    }
    solver_.solve(right_side_, step.beta, image, parallel_for);
}

/// Updates a band of rows. Each row adds to the right side of its own pixels and of the row below, which may
/// belong to the next band.
void L1Solver::update_band(const PoissonProblem& problem, const Step& step, const RgbImage& image, int band) {
    const int first = band * band_rows, end = std::min(first + band_rows, solver_.height());
    std::fill_n(right_side_.row(first), solver_.width(), Rgb(0));
    for (int y = first; y < end; ++y)
        update_row(problem, step, image, y, y + 1 < end ? values(right_side_, y + 1) : values(borders_, band));
}

/// Adds to row y of the right side, b = beta^2 (d - u)_primal + Dx^T (d - u)_dx + Dy^T (d - u)_dy, and writes the
/// contribution to the row below.
void L1Solver::update_row(const PoissonProblem& problem, const Step& step, const RgbImage& image, int y,
                          float* below) {
    const int width = solver_.width();
    const bool last_row = y + 1 == solver_.height();
    const TermUpdate gradient{Cut::joint,  step.old_threshold, step.threshold,      step.relaxation,
                              step.resume, step.park,          step.old_dual_scale, step.next_dual_scale};
    TermUpdate primal = gradient;
    primal.cut = step.primal_cut;
    primal.old_threshold = step.old_primal_threshold;
    primal.threshold = step.primal_threshold;
    const float weight = step.beta * step.beta;
    float now[chunk_values], primal_target[chunk_values], dx_target[3 + chunk_values] = {};
    for (int x = 0; x < width; x += chunk_pixels) {
        const int count = std::min(chunk_pixels, width - x), right = std::min(count, width - 1 - x);
        const int from = 3 * x;
        const float* own = values(image, y) + from;
        primal(count, values(problem.primal, y) + from, own, values(primal_, y) + from, primal_target);
        for (int i = 0; i < 3 * right; ++i)
            now[i] = own[i + 3] - own[i];
        std::fill(dx_target + 3 * count, dx_target + 3 + 3 * count, 0.0f);
        gradient(right, values(problem.dx, y) + from, now, values(dx_, y) + from, dx_target + 3);
        float* dy_target = below + from;
        if (last_row) {
            std::fill(dy_target, dy_target + 3 * count, 0.0f);
        } else {
            const float* next = values(image, y + 1) + from;
            for (int i = 0; i < 3 * count; ++i)
                now[i] = next[i] - own[i];
            gradient(count, values(problem.dy, y) + from, now, values(dy_, y) + from, dy_target);
        }
        float* out = values(right_side_, y) + from;
        for (int i = 0; i < 3 * count; ++i)
            out[i] += weight * primal_target[i] + dx_target[i] - dx_target[i + 3] - dy_target[i];
        std::copy_n(dx_target + 3 * count, 3, dx_target); // carried to the next chunk
    }
}

} // namespace tessera
