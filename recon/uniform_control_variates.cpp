#include "recon/uniform_control_variates.h"

#include <utility>

namespace tessera {

int average_neighbours(const PoissonProblem& problem, int iterations, RgbImage& image,
                       const ParallelFor& parallel_for, const SolveWatch& watch) {
    constexpr float share = 0.2f; // of each of four neighbours and the pixel itself
    const int width = problem.primal.width(), height = problem.primal.height();
    const PoissonProblem gradients{problem.primal, problem.dx, problem.dy, 0};
    image = problem.primal;
    RgbImage next(width, height);
    for (int i = 0; i < iterations; ++i) {
        if (!watch.goes_on(i, iterations))
            return 0;
        parallel_for(height, [&](int y) {
            poisson_defect(gradients, image, y, 0, width, &next.row(y)->x);
            for (int x = 0; x < width; ++x)
                next(x, y) = image(x, y) + share * next(x, y);
        });
        std::swap(image, next);
    }
    return iterations;
}

} // namespace tessera
