#include "recon/reconstruct.h"

#include "recon/poisson_direct.h"
#include "recon/poisson_l1.h"

#include <chrono>
#include <stdexcept>

namespace tessera {

namespace {

void check_sizes(const GradientImages& images) {
    for (const RgbImage* image : {&images.dx, &images.dy, &images.very_direct}) {
        const bool fits = image->width() == images.primal.width() && image->height() == images.primal.height();
        if (!image->empty() && !fits)
            throw std::invalid_argument("the images to reconstruct from differ in size");
    }
}

void add(RgbImage& sum, const RgbImage& image) {
    for (std::size_t i = 0; i < image.size(); ++i)
        sum.data()[i] += image.data()[i];
}

/// All but very direct light and time.
Reconstruction solve(const GradientImages& images, const ReconstructionSettings& settings,
                     const ParallelFor& parallel_for, std::stop_token stop) {
    Reconstruction result;
    const PoissonProblem problem{images.primal, images.dx, images.dy, settings.alpha};
    PoissonSolver solver(images.primal.width(), images.primal.height());
    if (settings.norm == Norm::l1) {
        result.iterations = solve_poisson_l1(problem, solver, result.image, parallel_for, stop);
    } else {
        solver.solve(problem, result.image, parallel_for);
        result.residual = poisson_residual(problem, result.image, parallel_for);
        result.iterations = 1;
    }
    if (stop.stop_requested())
        result.image = {};
    return result;
}

} // namespace

std::string_view to_string(Norm norm) {
    switch (norm) {
    case Norm::none:
        return "none";
    case Norm::l2:
        return "l2";
    case Norm::l1:
        return "l1";
    }
    return "?";
}

std::optional<Norm> norm_from_name(std::string_view name) {
    for (Norm norm : {Norm::none, Norm::l2, Norm::l1})
        if (to_string(norm) == name)
            return norm;
    return {};
}

Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, std::stop_token stop) {
    const auto start = std::chrono::steady_clock::now();
    check_sizes(images);
    if (settings.norm != Norm::none && !(settings.alpha > 0))
        throw std::invalid_argument("the reconstruction's alpha must be above 0");
    Reconstruction result;
    if (settings.norm == Norm::none || !images.has_gradients())
        result.image = images.primal;
    else
        result = solve(images, settings, parallel_for, stop);
    if (!result.image.empty())
        add(result.image, images.very_direct);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace tessera
