#include "recon/picture/reconstruct.h"

#include "recon/picture/bounds.h"
#include "recon/picture/demodulation.h"
#include "recon/picture/edge_weights.h"
#include "recon/picture/guide_kernel.h"
#include "recon/picture/guided.h"
#include "recon/picture/light_spreader.h"
#include "recon/picture/oidn.h"
#include "recon/picture/parts.h"
#include "recon/picture/shrinkage.h"
#include "recon/picture/spikes.h"
#include "recon/pixel_loops.h"
#include "recon/poisson_direct.h"
#include "recon/poisson_l1.h"
#include "recon/poisson_weighted.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

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
    const HalfDifferences& h = images.halves;
    const GuideImages& g = images.guides;
    if (g.albedo.empty() != g.normal.empty() || g.albedo.empty() != g.nearness.empty() ||
        g.albedo.empty() != g.roughness.empty() ||
        (images.has_gradients() && !h.empty() && (h.dx.empty() || h.dy.empty())))
        throw std::invalid_argument("the guides, or the halves' differences, are not complete");
    for (const RgbImage* image : {&images.dx, &images.dy, &images.very_direct, &d.value, &d.albedo,
                                  &d.sampled_albedo, &d.sampled_variance, &d.value_covariance, &b.primal, &b.dx,
                                  &b.dy, &b.albedo, &h.primal, &h.dx, &h.dy, &g.albedo, &g.normal, &images.own})
        check(*image);
    for (const Image<float>* variance :
         {&images.primal_variance, &images.dx_variance, &images.dy_variance, &d.albedo_variance, &d.sampled_share,
          &d.unexplained_variance, &b.half, &g.nearness, &g.roughness})
        check(*variance);
    for (const CoefficientPart& part : images.parts) {
        for (const RgbImage* image : {&part.primal, &part.dx, &part.dy})
            check(*image);
        for (const Image<float>* numbers :
             {&part.projection, &part.primal_variance, &part.dx_variance, &part.dy_variance})
            check(*numbers);
    }
}

void add(RgbImage& sum, const RgbImage& image, const ParallelFor& parallel_for) {
    for_pixels(image.width(), image.height(), parallel_for,
               [&](std::size_t i) { sum.data()[i] += image.data()[i]; });
}

/// Of all luminances.
double sum_of(const RgbImage& image, const ParallelFor& parallel_for) {
    return sum_over_pixels(image.width(), image.height(), parallel_for,
                           [&](std::size_t i) { return luminance(image.data()[i]); });
}

/// Whether a picture is smoothed by guides: whether there is what it takes.
bool smooths(const GradientImages& images, Norm norm) {
    const bool wants =
        norm == Norm::smoothed || (images.has_gradients() && (norm == Norm::guided || norm == Norm::oidn));
    return wants && !images.guides.empty() && !images.halves.empty();
}

/// Solvers go below black next to strong edges: radiance is not negative, unless the primal says so.
void lift_to_black(const RgbImage& primal, RgbImage& image, const ParallelFor& parallel_for) {
    parallel_for(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x)
            image(x, y) = glm::max(image(x, y), glm::min(primal(x, y), Rgb(0)));
    });
}

/// Pictures are kept below P + reach s (recon/picture/bounds.h).
constexpr float reach = 2;

/// Takes off what smoothing has put above the bounds, where it gave a dark pixel some of the light beside it.
/// (Bathroom at 3 samples: relMSE 3.3 without, 1.5 where that is spread about, 0.08 so.)
void hold_to_bounds(const UpperBounds& bounds, RgbImage& picture, const ParallelFor& parallel_for) {
    if (!bounds.empty())
        take_excess(bounds, reach, picture, parallel_for);
}

/// Gives the picture the light that it had, by one factor.
void keep_light(double before, RgbImage& picture, const ParallelFor& parallel_for) {
    const double after = sum_of(picture, parallel_for);
    if (!(before > 0 && after > 0))
        return;
    const auto factor = static_cast<float>(before / after);
    for_pixels(picture.width(), picture.height(), parallel_for,
               [&](std::size_t i) { picture.data()[i] *= factor; });
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
    std::optional<WeightedSolver> noise; ///< of guided
    EdgeWeights weights;                 ///< of the last images, until their picture is made
    std::optional<PartsSolver> parts;
    bool has_variances = false; ///< the last images that were weighted
};

/// What single samples are not believed, and what becomes of it.
struct Reconstructor::Limits {
    RgbImage held; ///< radiance that spikes hold back
    UpperBounds bounds;
    LitSurroundings surroundings; ///< of the picture in which light was spread; empty: there was none

    void spread(const GuideImages& guides, const AlikePixels& alike, RgbImage& image,
                const ParallelFor& parallel_for);
};

/// Gives what spikes hold back, and what the solver has put above the bounds, to pixels that look alike and have
/// room below theirs; and what is left over to those around, whatever their bounds: no light is lost, but where
/// all is black, and hardly any goes where it is known to be dark. Without bounds, only what is held.
void Reconstructor::Limits::spread(const GuideImages& guides, const AlikePixels& alike, RgbImage& image,
                                   const ParallelFor& parallel_for) {
    RgbImage light = copy_of(held, parallel_for);
    if (!bounds.empty())
        add(light, take_excess(bounds, reach, image, parallel_for), parallel_for);
    if (!(sum_of_sizes(light, parallel_for) > 0))
        return;
    const RgbImage room = room_below(bounds, reach, image, parallel_for);
    spread_to_alike(light, image, alike, guides, room, parallel_for);
    surroundings = lit_surroundings(image, alike, bounds.black, parallel_for);
    spread_around(light, surroundings, image, parallel_for);
}

Reconstructor::Reconstructor() = default;
Reconstructor::~Reconstructor() = default;

void Reconstructor::forget() {
    if (!solvers_)
        return;
    if (solvers_->l1)
        solvers_->l1->forget();
    for (std::optional<WeightedSolver>* solver : {&solvers_->weighted, &solvers_->noise})
        if (*solver)
            (*solver)->forget();
}

bool holds_back(const GradientImages& images, const ReconstructionSettings& settings) {
    // The denoiser has learnt what samples look like, spikes among them.
    const bool takes_samples = settings.norm == Norm::oidn && !images.has_gradients();
    return settings.spikes == Spikes::consistent && can_limit(images) && !takes_samples;
}

std::uint64_t Reconstructor::bytes_for(int width, int height, Norm norm, int threads, int parts,
                                       bool is_limited) const {
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * height, image = sizeof(Rgb) * pixels;
    const std::uint64_t alike = is_limited ? 0 : AlikePixels::bytes_a_pixel * pixels;
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
    case Norm::guided:
    case Norm::oidn: { // the smoothing comes when both are solved, and the denoiser after it
        const std::uint64_t solver = WeightedSolver::bytes(width, height, threads);
        const std::uint64_t denoiser = norm == Norm::oidn ? 6 * image + bytes_of_oidn(width, height) : 0;
        return 2 * image + alike + std::max(bytes_to_smooth(width, height), denoiser) +
               (kept && kept->weighted ? 0 : solver) + (kept && kept->noise ? 0 : solver);
    }
    case Norm::smoothed:
        return 2 * image + alike + bytes_to_smooth(width, height);
    }
    return 0;
}

int Reconstructor::solve_weighted(const GradientImages& images, const PoissonProblem& problem,
                                  const AlikePixels* alike, RgbImage& image, const ParallelFor& parallel_for,
                                  const SolveWatch& watch) {
    WeightedSolver& solver = solvers_->made(solvers_->weighted);
    if (std::exchange(solvers_->has_variances, images.has_variances()) != images.has_variances())
        forget(); // weights from neighbours are unlike those from samples
    solvers_->weights = weights_of_gradients(images, problem.alpha, alike, parallel_for);
    return solver.solve(problem, solvers_->weights, {}, image, parallel_for, watch);
}

/// The noise of a picture that was made by the same equations, radiance: what the halves of the samples make of
/// it, with what of the light held back is in one or the other. Anything: stopped.
RgbImage Reconstructor::noise_of(const GradientImages& images, const ReconstructionSettings& settings,
                                 const Limits* limits, const ParallelFor& parallel_for, const SolveWatch& watch) {
    RgbImage noise;
    if (images.has_gradients() && settings.norm != Norm::smoothed) {
        const float alpha = weighted_alpha(settings.alpha, images.patch);
        const PoissonProblem halves{images.halves.primal, images.halves.dx, images.halves.dy, alpha};
        // Noise need not be known better than it is alike from one half to another.
        constexpr WeightedSettings quick{.cold_iterations = 2, .warm_iterations = 2};
        solvers_->made(solvers_->noise).solve(halves, solvers_->weights, quick, noise, parallel_for, watch);
        solvers_->weights = {};
    } else {
        noise = copy_of(images.halves.primal, parallel_for);
    }
    multiply_by_known_albedo(images.demodulation, noise, parallel_for);
    if (limits && !images.brightest.half.empty()) {
        RgbImage held(noise.width(), noise.height(), Unfilled());
        for_pixels(held.width(), held.height(), parallel_for, [&](std::size_t i) {
            held.data()[i] = limits->held.data()[i] * images.brightest.half.data()[i];
        });
        // To pixels that look alike farther away, too, is level.
        spread_around(held, limits->surroundings, noise, parallel_for);
    }
    return noise;
}

/// Reconstructs without very direct light, and takes no time.
Reconstruction Reconstructor::solve(const GradientImages& images, const ReconstructionSettings& settings,
                                    const AlikePixels* alike, const ParallelFor& parallel_for,
                                    const SolveWatch& watch) {
    const int width = images.primal.width(), height = images.primal.height();
    if (!solvers_ || solvers_->width != width || solvers_->height != height)
        solvers_ = std::make_unique<Solvers>(width, height);
    PoissonProblem problem{images.primal, images.dx, images.dy, settings.alpha};
    Reconstruction result;
    if (images.parts.empty())
        solvers_->parts.reset();
    if (!images.parts.empty() && expands(settings.norm)) {
        const float alpha =
            settings.norm == Norm::weighted ? weighted_alpha(settings.alpha, images.patch) : settings.alpha;
        result.iterations =
            solvers_->made(solvers_->parts).solve(images, settings.norm, alpha, result.image, parallel_for, watch);
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
    case Norm::weighted:
    case Norm::guided: // what comes after these is reconstruct()'s
    case Norm::oidn:
        problem.alpha = weighted_alpha(settings.alpha, images.patch);
        result.iterations = solve_weighted(images, problem, alike, result.image, parallel_for, watch);
        break;
    }
    if (watch.is_stopped())
        result.image = {};
    return result;
}

/// Without very direct light.
Reconstruction Reconstructor::picture_of(const GradientImages& images, const ReconstructionSettings& settings,
                                         const AlikePixels* alike, const ParallelFor& parallel_for,
                                         const SolveWatch& watch) {
    Reconstruction result = solve(images, settings, alike, parallel_for, watch);
    const bool is_unbiased = images.has_gradients() && is_linear(settings.norm);
    if (!images.demodulation.empty() && !result.image.empty())
        remodulate(images, is_unbiased, result.image, parallel_for);
    if (!is_unbiased && (images.has_gradients() || !images.demodulation.empty()))
        lift_to_black(images.radiance(), result.image, parallel_for);
    return result;
}

/// What is done to a picture without very direct light after it is solved. Empties it: stopped.
void Reconstructor::finish(const GradientImages& images, const ReconstructionSettings& settings,
                           const AlikePixels* alike, const Limits* limits, RgbImage& picture,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    const bool has_gradients = images.has_gradients();
    const double light = sum_of(picture, parallel_for);
    RgbImage noise;
    if (smooths(images, settings.norm)) {
        noise = noise_of(images, settings, limits, parallel_for, watch);
        NoisyPicture smooth =
            smooth_by_guides({std::move(picture), std::move(noise)}, images.guides, *alike, parallel_for, watch);
        picture = std::move(smooth.image);
        noise = std::move(smooth.noise);
        if (limits && !picture.empty())
            hold_to_bounds(limits->bounds, picture, parallel_for);
        // Pixels do not get of others what they give them, and bounds take some.
        keep_light(light, picture, parallel_for);
    }
    if (settings.norm == Norm::oidn && !watch.is_stopped()) {
        const bool has_own = has_gradients && !images.own.empty();
        const RgbImage target = denoised_by_oidn(has_own ? images.own : picture, images.guides);
        picture = shrink_toward(target, {std::move(picture), std::move(noise)}, images.guides, parallel_for);
        if (limits)
            hold_to_bounds(limits->bounds, picture, parallel_for); // of the target's light in the dark, too
        if (has_gradients)
            keep_light(light, picture, parallel_for);
    }
    if (watch.is_stopped())
        picture = {};
}

Reconstruction Reconstructor::reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                                          const ParallelFor& parallel_for, const SolveWatch& watch) {
    const auto start = std::chrono::steady_clock::now();
    check_sizes(images);
    if (settings.norm != Norm::guided && settings.norm != Norm::oidn && solvers_ && solvers_->noise)
        solvers_->noise->forget(); // its last noise is long ago
    if (settings.norm != Norm::none && !(settings.alpha > 0))
        throw std::invalid_argument("the reconstruction's alpha must be above 0");
    const bool is_limited = holds_back(images, settings);
    RgbImage held;
    const GradientImages limited_images = is_limited ? limited(images, held, parallel_for) : GradientImages();
    const GradientImages& counted = is_limited ? limited_images : images;
    std::optional<AlikePixels> alike;
    if (is_limited || smooths(images, settings.norm))
        alike.emplace(glm::ivec2(images.primal.width(), images.primal.height()), images.guides, parallel_for);
    const bool is_told_alike = is_limited && !images.guides.empty();
    Reconstruction result = picture_of(counted, settings, is_told_alike ? &*alike : nullptr, parallel_for, watch);
    std::optional<Limits> limits;
    if (is_limited && !result.image.empty()) {
        UpperBounds bounds = upper_bounds(counted, images.radiance(), *alike, parallel_for);
        limits.emplace(std::move(held), std::move(bounds), LitSurroundings());
        limits->spread(images.guides, *alike, result.image, parallel_for);
        const double all = sum_of(images.radiance(), parallel_for);
        result.held_share = all > 0 ? sum_of(limits->held, parallel_for) / all : 0;
    }
    if (!result.image.empty())
        finish(counted, settings, alike ? &*alike : nullptr, limits ? &*limits : nullptr, result.image,
               parallel_for, watch);
    solvers_->weights = {};
    if (!result.image.empty())
        add(result.image, images.very_direct, parallel_for);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    return Reconstructor().reconstruct(images, settings, parallel_for, watch);
}

} // namespace tessera
