#include "recon/reconstruct.h"

#include "recon/bounds.h"
#include "recon/demodulation.h"
#include "recon/poisson_direct.h"
#include "recon/poisson_l1.h"
#include "recon/poisson_parts.h"
#include "recon/poisson_weighted.h"
#include "recon/spikes.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

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

namespace {

constexpr int uniform_iterations = 50;

void check_sizes(const GradientImages& images) {
    const auto check = [&](const auto& image) {
        const bool fits = image.width() == images.primal.width() && image.height() == images.primal.height();
        if (!image.empty() && !fits)
            throw std::invalid_argument("the images to reconstruct from differ in size");
    };
    const Demodulation& d = images.demodulation;
    const BrightestSamples& b = images.brightest;
    for (const RgbImage* image :
         {&images.dx, &images.dy, &images.very_direct, &d.value, &d.albedo, &d.sampled_albedo, &d.sampled_variance,
          &d.value_covariance, &b.primal, &b.dx, &b.dy, &b.albedo})
        check(*image);
    for (const Image<float>* variance : {&images.primal_variance, &images.dx_variance, &images.dy_variance,
                                         &d.albedo_variance, &d.sampled_share, &d.unexplained_variance})
        check(*variance);
    for (const CoefficientPart& part : images.parts) {
        for (const RgbImage* image : {&part.primal, &part.dx, &part.dy})
            check(*image);
        for (const Image<float>* numbers :
             {&part.projection, &part.primal_variance, &part.dx_variance, &part.dy_variance})
            check(*numbers);
    }
}

void add(RgbImage& sum, const RgbImage& image) {
    for (std::size_t i = 0; i < image.size(); ++i)
        sum.data()[i] += image.data()[i];
}

/// Of all luminances.
double sum_of(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += static_cast<double>(luminance(c));
    return sum;
}

/// Where noise is alike in squares of `patch` pixels, each pixel says less on its own, and the picture must be
/// smoothed over the squares. Tried out on tiles of 6 pixels: alpha 0.2 leaves blobs, 0.1 and 0.07 are level.
float alpha_of_patches(float alpha, float patch) {
    return alpha / std::sqrt(patch);
}

/// Solvers go below black next to strong edges: radiance is not negative, unless the primal says so.
void lift_to_black(const RgbImage& primal, RgbImage& image, const ParallelFor& parallel_for) {
    parallel_for(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x)
            image(x, y) = glm::max(image(x, y), glm::min(primal(x, y), Rgb(0)));
    });
}

/// Gives what spikes hold back, and what the solver has put above the bounds, to the pixels around, and once more
/// what pixels thereby have above the bounds: no light is lost, and hardly any goes where it is known to be dark.
/// (Three more times gain nothing.)
void spread_within_bounds(const GradientImages& images, RgbImage held, RgbImage& image,
                          const ParallelFor& parallel_for) {
    if (!can_bound(images))
        return LightSpreader(image, parallel_for).spread(held, image, parallel_for);
    const RgbImage bounds = upper_bounds(images, parallel_for);
    add(held, take_excess(bounds, image));
    const LightSpreader spreader(image, parallel_for);
    spreader.spread(held, image, parallel_for);
    spreader.spread(take_excess(bounds, image), image, parallel_for);
}

} // namespace

/// The solvers of one size; each is made when it is first asked for.
struct Reconstructor::Solvers {
    template <class Solver>
    Solver& made(std::optional<Solver>& solver) {
        if (!solver)
            solver.emplace(width, height);
        return *solver;
    }

    int width, height;
    std::optional<PoissonSolver> l2;
    std::optional<L1Solver> l1;
    std::optional<WeightedSolver> weighted;
    std::optional<PartsSolver> parts;
    bool has_variances = false; ///< the last images that were weighted
};

Reconstructor::Reconstructor() = default;
Reconstructor::~Reconstructor() = default;

void Reconstructor::forget() {
    if (!solvers_)
        return;
    if (solvers_->l1)
        solvers_->l1->forget();
    if (solvers_->weighted)
        solvers_->weighted->forget();
}

std::uint64_t Reconstructor::bytes_for(int width, int height, Norm norm, int threads, int parts) const {
    const std::uint64_t image = sizeof(Rgb) * static_cast<std::uint64_t>(width) * height;
    const Solvers* kept =
        solvers_ && solvers_->width == width && solvers_->height == height ? &*solvers_ : nullptr;
    if (parts > 0 && expands(norm))
        return image + (kept && kept->parts && kept->parts->parts() >= parts
                            ? 0
                            : PartsSolver::bytes(width, height, parts, threads));
    switch (norm) {
    case Norm::none:
        return image;
    case Norm::uniform:
        return 2 * image;
    case Norm::l2:
        return image + (kept && kept->l2 ? 0 : PoissonSolver::bytes(width, height, threads));
    case Norm::l1:
    case Norm::mixed:
        return image + (kept && kept->l1 ? 0 : L1Solver::bytes(width, height, threads));
    case Norm::weighted:
        return image + EdgeWeights::bytes(width, height) +
               (kept && kept->weighted ? 0 : WeightedSolver::bytes(width, height, threads));
    }
    return 0;
}

std::string_view to_string(Norm norm) {
    switch (norm) {
    case Norm::none:
        return "none";
    case Norm::l2:
        return "l2";
    case Norm::l1:
        return "l1";
    case Norm::mixed:
        return "mixed";
    case Norm::uniform:
        return "uniform";
    case Norm::weighted:
        return "weighted";
    }
    return "?";
}

std::string_view to_string(Spikes spikes) {
    return spikes == Spikes::off ? "off" : "consistent";
}

std::optional<Norm> norm_from_name(std::string_view name) {
    for (const Norm norm : all_norms)
        if (to_string(norm) == name)
            return norm;
    return {};
}

bool expands(Norm norm) {
    return norm == Norm::l2 || norm == Norm::l1 || norm == Norm::mixed || norm == Norm::weighted;
}

bool is_linear(Norm norm) {
    return norm == Norm::none || norm == Norm::l2 || norm == Norm::uniform;
}

/// Reconstructs without very direct light, and takes no time.
Reconstruction Reconstructor::solve(const GradientImages& images, const ReconstructionSettings& settings,
                                    const ParallelFor& parallel_for, const SolveWatch& watch) {
    const int width = images.primal.width(), height = images.primal.height();
    if (!solvers_ || solvers_->width != width || solvers_->height != height)
        solvers_ = std::make_unique<Solvers>(width, height);
    PoissonProblem problem{images.primal, images.dx, images.dy, settings.alpha};
    Reconstruction result;
    if (images.parts.empty())
        solvers_->parts.reset();
    if (!images.parts.empty() && expands(settings.norm)) {
        const float alpha =
            settings.norm == Norm::weighted ? alpha_of_patches(settings.alpha, images.patch) : settings.alpha;
        result.iterations =
            solvers_->made(solvers_->parts).solve(images, settings.norm, alpha, result.image, parallel_for, watch);
        if (watch.is_stopped())
            result.image = {};
        return result;
    }
    switch (images.has_gradients() ? settings.norm : Norm::none) {
    case Norm::none:
        result.image = images.primal;
        break;
    case Norm::l2:
        solvers_->made(solvers_->l2).solve(problem, result.image, parallel_for);
        result.residual = poisson_residual(problem, result.image, parallel_for);
        result.iterations = 1;
        break;
    case Norm::l1:
    case Norm::mixed: {
        const L1Settings l1{.square_primal = settings.norm == Norm::mixed, .joint_colour = settings.joint_colour};
        result.iterations = solvers_->made(solvers_->l1).solve(problem, l1, result.image, parallel_for, watch);
        break;
    }
    case Norm::uniform:
        result.iterations = average_neighbours(problem, uniform_iterations, result.image, parallel_for, watch);
        break;
    case Norm::weighted: {
        WeightedSolver& solver = solvers_->made(solvers_->weighted);
        if (std::exchange(solvers_->has_variances, images.has_variances()) != images.has_variances())
            solver.forget(); // weights from neighbours are unlike those from samples
        problem.alpha = alpha_of_patches(settings.alpha, images.patch);
        const EdgeWeights weights = weights_of_gradients(images, problem.alpha, parallel_for);
        result.iterations = solver.solve(problem, weights, {}, result.image, parallel_for, watch);
        break;
    }
    }
    if (watch.is_stopped())
        result.image = {};
    return result;
}

/// Without very direct light.
Reconstruction Reconstructor::picture_of(const GradientImages& images, const ReconstructionSettings& settings,
                                         const ParallelFor& parallel_for, const SolveWatch& watch) {
    Reconstruction result = solve(images, settings, parallel_for, watch);
    const bool is_unbiased = images.has_gradients() && is_linear(settings.norm);
    if (!images.demodulation.empty() && !result.image.empty())
        remodulate(images, is_unbiased, result.image, parallel_for);
    if (!is_unbiased && (images.has_gradients() || !images.demodulation.empty()))
        lift_to_black(images.radiance(), result.image, parallel_for);
    return result;
}

Reconstruction Reconstructor::reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                                          const ParallelFor& parallel_for, const SolveWatch& watch) {
    const auto start = std::chrono::steady_clock::now();
    check_sizes(images);
    if (settings.norm != Norm::none && !(settings.alpha > 0))
        throw std::invalid_argument("the reconstruction's alpha must be above 0");
    Reconstruction result;
    if (settings.spikes == Spikes::consistent && can_limit(images)) {
        RgbImage held;
        const GradientImages limited_images = limited(images, held, parallel_for);
        result = picture_of(limited_images, settings, parallel_for, watch);
        if (!result.image.empty())
            spread_within_bounds(limited_images, held, result.image, parallel_for);
        const double all = sum_of(images.radiance());
        result.held_share = all > 0 ? sum_of(held) / all : 0;
    } else {
        result = picture_of(images, settings, parallel_for, watch);
    }
    if (!result.image.empty())
        add(result.image, images.very_direct);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    return Reconstructor().reconstruct(images, settings, parallel_for, watch);
}

} // namespace tessera
