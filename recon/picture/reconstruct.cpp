#include "recon/picture/reconstruct.h"

#include "recon/picture/bounds.h"
#include "recon/picture/demodulation.h"
#include "recon/picture/edge_weights.h"
#include "recon/picture/guide_kernel.h"
#include "recon/picture/guided.h"
#include "recon/picture/light_spreader.h"
#include "recon/picture/oidn.h"
#include "recon/picture/picture_solvers.h"
#include "recon/picture/shrinkage.h"
#include "recon/picture/spikes.h"
#include "recon/pixel_loops.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

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
    const auto factor = static_cast<float>(before / after);
    if (!(before > 0 && after > 0 && std::isfinite(factor)))
        return;
    for_pixels(picture.width(), picture.height(), parallel_for,
               [&](std::size_t i) { picture.data()[i] *= factor; });
}

/// What a picture is made of and how, as far as that tells what is found about it.
struct Circumstances {
    ReconstructionSettings settings;
    bool is_limited, is_smoothed, has_gradients, has_variances, has_guides, is_demodulated;
    std::size_t parts;
    float patch;

    Circumstances(const GradientImages& images, const ReconstructionSettings& asked)
        : settings(asked), is_limited(holds_back(images, asked)), is_smoothed(smooths(images, asked.norm)),
          has_gradients(images.has_gradients()), has_variances(images.has_variances()),
          has_guides(!images.guides.empty()), is_demodulated(!images.demodulation.empty()),
          parts(images.parts.size()), patch(images.patch) {}
    bool operator==(const Circumstances&) const = default;
};

} // namespace

/// What is found about a picture beside its light.
struct Reconstructor::Fit {
    Circumstances circumstances;
    int samples;                        ///< that each pixel had; 0: unknown
    std::optional<AlikePixels> alike{}; ///< none: nothing is smoothed or held back
    EdgeWeights weights{};
    UpperBounds bounds{};
    LitSurroundings surroundings{}; ///< of the picture in which light was spread; empty: there was none
    SmoothingFit smoothing{};

    /// With a quarter more samples, noise is less by a tenth.
    bool holds_for(const Circumstances& now, int samples_now) const {
        return circumstances == now && samples_now >= samples && 4 * samples_now < 5 * samples;
    }
    /// Whether it can for one sample more: of fewer than five samples each that comes is a quarter.
    bool can_hold() const {
        return holds_for(circumstances, samples + 1) && circumstances.settings.norm != Norm::oidn;
    }
    bool is_whole() const { return smoothing.empty() == !circumstances.is_smoothed; }

    std::uint64_t bytes() const {
        const auto bytes_of = [](const auto& image) { return image.size() * sizeof(*image.data()); };
        return (alike ? alike->bytes() : 0) + bytes_of(weights.x) + bytes_of(weights.y) + bytes_of(bounds.light) +
               bytes_of(bounds.error) + bytes_of(bounds.black) + bytes_of(surroundings.brightness) +
               bytes_of(surroundings.around) + SmoothingFit::bytes_a_pixel * smoothing.trust[0].size();
    }
};

/// A picture that is being made.
struct Reconstructor::Task {
    const GradientImages& given;
    const GradientImages& images; ///< `given` without what spikes hold back
    const RgbImage* held;         ///< radiance that they do; null: they are let through
    const ReconstructionSettings& settings;
    Fit& fit;
    bool has_fit;   ///< `fit` is one of before
    bool keeps_fit; ///< it is for pictures to come
    const ParallelFor& parallel_for;
    const SolveWatch& watch;
};

Reconstructor::Reconstructor() = default;
Reconstructor::~Reconstructor() = default;

void Reconstructor::forget() {
    has_solved_ = false;
    fit_.reset();
    if (solvers_)
        solvers_->forget();
}

void Reconstructor::set_keeps(bool keeps) {
    keeps_ = keeps;
    if (!keeps)
        fit_.reset();
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
    const PictureSolvers none(width, height);
    const bool has_some = solvers_ && solvers_->width() == width && solvers_->height() == height;
    const std::uint64_t solvers = (has_some ? *solvers_ : none).bytes_for(norm, threads, parts);
    if (parts > 0 && expands(norm))
        return image + solvers;
    switch (norm) {
    case Norm::none:
    case Norm::l2:
    case Norm::l1:
    case Norm::mixed:
        return image + solvers;
    case Norm::uniform:
        return 2 * image;
    case Norm::weighted:
        return image + EdgeWeights::bytes(width, height) + solvers;
    case Norm::guided:
    case Norm::oidn: { // the smoothing comes when both are solved, and the denoiser after it
        const std::uint64_t denoiser = norm == Norm::oidn ? 6 * image + bytes_of_oidn(width, height) : 0;
        return 2 * image + alike + std::max(bytes_to_smooth(width, height), denoiser) + solvers;
    }
    case Norm::smoothed:
        return 2 * image + alike + bytes_to_smooth(width, height);
    }
    return 0;
}

std::uint64_t Reconstructor::bytes_to_keep(int width, int height) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * height;
    return SmoothingFit::bytes_a_pixel * pixels + EdgeWeights::bytes(width, height);
}

std::uint64_t Reconstructor::bytes_kept() const {
    return fit_ ? fit_->bytes() : 0;
}

/// Without very direct light.
Reconstruction Reconstructor::picture_of(const Task& task) {
    const GradientImages& images = task.images;
    const Norm norm = task.settings.norm;
    const bool is_weighted = PictureSolvers::weighs_gradients(images, norm);
    if (is_weighted && std::exchange(has_variances_, images.has_variances()) != images.has_variances())
        solvers_->forget(); // weights from neighbours are unlike those from samples
    if (is_weighted && !task.has_fit) {
        const bool is_told_alike = task.held && !task.given.guides.empty();
        task.fit.weights = weights_of_gradients(images, weighted_alpha(task.settings.alpha, images.patch),
                                                is_told_alike ? &*task.fit.alike : nullptr, task.parallel_for);
    }
    Reconstruction result =
        solvers_->solve(images, task.settings, task.fit.weights, task.has_fit, task.parallel_for, task.watch);
    const bool is_unbiased = images.has_gradients() && is_linear(norm);
    if (!images.demodulation.empty() && !result.image.empty())
        remodulate(images, is_unbiased, result.image, task.parallel_for);
    if (!is_unbiased && (images.has_gradients() || !images.demodulation.empty()))
        lift_to_black(images.radiance(), result.image, task.parallel_for);
    return result;
}

/// Gives what spikes hold back, and what the solver has put above the bounds, to pixels that look alike and have
/// room below theirs; and what is left over to those around, whatever their bounds: no light is lost, but where
/// all is black, and hardly any goes where it is known to be dark. Without bounds, only what is held.
void Reconstructor::spread_held(const Task& task, RgbImage& image) {
    Fit& fit = task.fit;
    const ParallelFor& parallel_for = task.parallel_for;
    if (!task.has_fit)
        fit.bounds = upper_bounds(task.images, task.given, *fit.alike, parallel_for);
    RgbImage light = copy_of(*task.held, parallel_for);
    if (!fit.bounds.empty())
        add(light, take_excess(fit.bounds, reach, image, parallel_for), parallel_for);
    if (!(sum_of_sizes(light, parallel_for) > 0))
        return;
    const RgbImage room = room_below(fit.bounds, reach, image, parallel_for);
    spread_to_alike(light, image, *fit.alike, task.given.guides, room, parallel_for);
    if (fit.surroundings.brightness.empty())
        fit.surroundings = lit_surroundings(image, *fit.alike, fit.bounds.black, parallel_for);
    spread_around(light, fit.surroundings, image, parallel_for);
}

/// The noise of a picture that was made by the same equations, radiance: what the halves of the samples make of
/// it, with what of the light held back is in one or the other. Anything: stopped.
RgbImage Reconstructor::noise_of(const Task& task) {
    const GradientImages& images = task.images;
    const ParallelFor& parallel_for = task.parallel_for;
    RgbImage noise;
    if (PictureSolvers::weighs_gradients(images, task.settings.norm))
        noise = solvers_->solve_halves(images, task.settings.alpha, task.fit.weights, parallel_for, task.watch);
    else
        noise = copy_of(images.halves.primal, parallel_for);
    if (!task.keeps_fit)
        task.fit.weights = {};
    multiply_by_known_albedo(images.demodulation, noise, parallel_for);
    if (!task.fit.surroundings.brightness.empty() && !images.brightest.half.empty()) {
        RgbImage held(noise.width(), noise.height(), Unfilled());
        for_pixels(held.width(), held.height(), parallel_for, [&](std::size_t i) {
            held.data()[i] = task.held->data()[i] * images.brightest.half.data()[i];
        });
        // To pixels that look alike farther away, too, is level.
        spread_around(held, task.fit.surroundings, noise, parallel_for);
    }
    return noise;
}

/// Smooths a picture without very direct light, and returns the noise that is left, as far as it is told.
RgbImage Reconstructor::smooth(const Task& task, RgbImage& picture) {
    const GuideImages& guides = task.given.guides;
    Fit& fit = task.fit;
    const double light = sum_of(picture, task.parallel_for);
    RgbImage noise;
    if (task.has_fit) {
        picture =
            smooth_likewise(std::move(picture), guides, *fit.alike, fit.smoothing, task.parallel_for, task.watch);
    } else {
        NoisyPicture smooth =
            smooth_by_guides({std::move(picture), noise_of(task)}, guides, *fit.alike, task.parallel_for,
                             task.watch, task.keeps_fit ? &fit.smoothing : nullptr);
        picture = std::move(smooth.image);
        noise = std::move(smooth.noise);
    }
    if (task.held && !picture.empty())
        hold_to_bounds(fit.bounds, picture, task.parallel_for);
    // Pixels do not get of others what they give them, and bounds take some.
    keep_light(light, picture, task.parallel_for);
    return noise;
}

/// What is done to a picture without very direct light after it is solved. Empties it: stopped.
void Reconstructor::finish(const Task& task, RgbImage& picture) {
    const GradientImages& given = task.given;
    const bool has_gradients = given.has_gradients();
    RgbImage noise;
    if (smooths(given, task.settings.norm))
        noise = smooth(task, picture);
    if (task.settings.norm == Norm::oidn && !task.watch.is_stopped()) {
        const double light = sum_of(picture, task.parallel_for);
        const bool has_own = has_gradients && !given.own.empty();
        const RgbImage target = denoised_by_oidn(has_own ? given.own : picture, given.guides);
        picture = shrink_toward(target, {std::move(picture), std::move(noise)}, given.guides, task.parallel_for);
        if (task.held)
            hold_to_bounds(task.fit.bounds, picture, task.parallel_for); // of the target's light in the dark, too
        if (has_gradients)
            keep_light(light, picture, task.parallel_for);
    }
    if (task.watch.is_stopped())
        picture = {};
}

Reconstruction Reconstructor::reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                                          const ParallelFor& parallel_for, const SolveWatch& watch) {
    const auto start = std::chrono::steady_clock::now();
    check_sizes(images);
    if (settings.norm != Norm::none && !(settings.alpha > 0))
        throw std::invalid_argument("the reconstruction's alpha must be above 0");
    const int width = images.primal.width(), height = images.primal.height();
    if (!solvers_ || solvers_->width() != width || solvers_->height() != height) {
        forget();
        solvers_ = std::make_unique<PictureSolvers>(width, height);
    }
    if (settings.norm != Norm::guided && settings.norm != Norm::oidn)
        solvers_->forget_halves(); // the last ones are long ago
    const Circumstances now(images, settings);
    const bool has_fit = fit_ && fit_->holds_for(now, images.brightest.samples);
    if (!has_fit)
        fit_.reset();
    auto fit = has_fit ? std::move(fit_) : std::make_unique<Fit>(Fit{now, images.brightest.samples});
    RgbImage held;
    const GradientImages limited_images =
        now.is_limited ? limited(images, !has_fit, held, parallel_for) : GradientImages();
    if (!has_fit && (now.is_limited || now.is_smoothed))
        fit->alike.emplace(glm::ivec2(width, height), images.guides, parallel_for);
    const Task task{.given = images,
                    .images = now.is_limited ? limited_images : images,
                    .held = now.is_limited ? &held : nullptr,
                    .settings = settings,
                    .fit = *fit,
                    .has_fit = has_fit,
                    .keeps_fit = keeps_ && has_solved_ && fit->can_hold(),
                    .parallel_for = parallel_for,
                    .watch = watch};
    Reconstruction result = picture_of(task);
    result.goes_on = has_fit;
    if (now.is_limited && !result.image.empty()) {
        spread_held(task, result.image);
        const double all = sum_of(images.radiance(), parallel_for);
        result.held_share = all > 0 ? sum_of(held, parallel_for) / all : 0;
    }
    if (!result.image.empty())
        finish(task, result.image);
    if (!result.image.empty()) {
        add(result.image, images.very_direct, parallel_for);
        has_solved_ = true;
        if (task.keeps_fit && fit->is_whole())
            fit_ = std::move(fit);
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    return Reconstructor().reconstruct(images, settings, parallel_for, watch);
}

} // namespace tessera
