#include "recon/poisson_l1.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// The median over the lit pixels of their largest channel, from some thousand pixels of the image: a scale that
/// an outlier does not move. 1 for a black image.
float typical_value(const RgbImage& image) {
    const std::size_t step = std::max<std::size_t>(image.size() / 4096, 1);
    std::vector<float> values;
    for (std::size_t i = 0; i < image.size(); i += step) {
        const Rgb c = glm::abs(image.data()[i]);
        const float value = std::max({c.r, c.g, c.b});
        if (value > 0)
            values.push_back(value);
    }
    if (values.empty())
        return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// One of the three terms |K I - g|: its scaled dual variable u, and the target g + z - u of the next inner solve.
struct Term {
    explicit Term(const RgbImage& data) : given(data), dual(data.width(), data.height()), target(data) {}

    /// Takes K I - g at a pixel; `weight` is that of the term's target in the inner problem.
    void update(int x, int y, Rgb misfit, float weight, float threshold, float dual_scale) {
        const Rgb w = misfit + dual(x, y);
        const float length = glm::length(w);
        const Rgb u = length > threshold ? w * (threshold / length) : w;
        const Rgb z = w - u; // w shrunk by the threshold
        dual(x, y) = u * dual_scale;
        target(x, y) = given(x, y) + (z - dual(x, y)) / weight;
    }

    const RgbImage& given;
    RgbImage dual;
    RgbImage target;
};

void update_row(const RgbImage& image, int y, float alpha, float threshold, float dual_scale, Term& primal,
                Term& dx, Term& dy) {
    for (int x = 0; x < image.width(); ++x) {
        const Rgb own = image(x, y);
        primal.update(x, y, alpha * (own - primal.given(x, y)), alpha, threshold, dual_scale);
        if (x + 1 < image.width())
            dx.update(x, y, image(x + 1, y) - own - dx.given(x, y), 1, threshold, dual_scale);
        if (y + 1 < image.height())
            dy.update(x, y, image(x, y + 1) - own - dy.given(x, y), 1, threshold, dual_scale);
    }
}

} // namespace

// The alternating direction method of multipliers [Boyd 2011, 6.1]: with K = (Dx, Dy, alpha), g = (dx, dy, alpha
// primal) and z = K I - g, in turn
//     I = argmin |K I - (g + z - u)|^2,   z = shrink(K I - g + u, t),   u = u + K I - g - z .
// The first is the screened Poisson problem. u is then w = K I - g + u cut to length t, and z = w - u. The
// threshold t starts high, which moves far, and falls, which settles; u is proportional to it.
int solve_poisson_l1(const PoissonProblem& problem, PoissonSolver& solver, RgbImage& image,
                     const ParallelFor& parallel_for, std::stop_token stop, int iterations) {
    constexpr float first_threshold = 0.2f, last_threshold = 0.01f, decay = 0.9f; // in units of a typical pixel
    const float scale = typical_value(problem.primal);
    Term primal(problem.primal), dx(problem.dx), dy(problem.dy);
    solver.solve(problem, image, parallel_for);
    float threshold = first_threshold;
    for (int i = 1; i < iterations; ++i) {
        if (stop.stop_requested())
            return 0;
        const float next = std::max(threshold * decay, last_threshold);
        parallel_for(image.height(), [&](int y) {
            update_row(image, y, problem.alpha, threshold * scale, next / threshold, primal, dx, dy);
        });
        threshold = next;
        solver.solve({primal.target, dx.target, dy.target, problem.alpha}, image, parallel_for);
    }
    return stop.stop_requested() ? 0 : iterations;
}

} // namespace tessera
