#include "recon/picture/reconstruct.h"

#include "recon/guided/demodulation.h"
#include "recon/guided/guided.h"
#include "recon/picture/oidn.h"
#include "recon/pixel_loops.h"
#include "recon/solvers/picture_solvers.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace tessera {

namespace {

void check_sizes(const GradientImages& images) {
    const auto check = [&](const auto& image) {
        const bool fits = image.width() == images.primal.width() && image.height() == images.primal.height();
        if (!image.empty() && !fits)
            throw std::invalid_argument("the images to reconstruct differ in size");
    };
    const Demodulation& d = images.demodulation;
    const BrightestSamples& b = images.brightest;
    const HalfDifferences& h = images.halves;
    const FeatureImages& g = images.features;
    if (g.albedo.empty() != g.normal.empty() || g.albedo.empty() != g.nearness.empty() ||
        g.albedo.empty() != g.roughness.empty() ||
        (images.has_gradients() && !h.empty() && (h.dx.empty() || h.dy.empty())))
        throw std::invalid_argument("the features or the half differences are incomplete");
    for (const RgbImage* image :
         {&images.dx, &images.dy, &images.very_direct, &d.value, &d.albedo, &d.sampled_albedo, &d.sampled_variance,
          &d.value_covariance, &b.primal, &b.dx, &b.dy, &b.albedo, &h.primal, &h.dx, &h.dy, &g.albedo, &g.normal})
        check(*image);
    for (const Image<float>* variance :
         {&images.primal_variance, &images.dx_variance, &images.dy_variance, &d.albedo_variance, &d.sampled_weight,
          &d.unexplained_variance, &b.half, &g.nearness, &g.roughness})
        check(*variance);
    for (const BasisComponent& component : images.components) {
        for (const RgbImage* image : {&component.primal, &component.dx, &component.dy})
            check(*image);
        for (const Image<float>* numbers :
             {&component.projection, &component.primal_variance, &component.dx_variance, &component.dy_variance})
            check(*numbers);
    }
}

/// Properties that two pictures must share for one fit to serve both.
struct FitKey {
    ReconstructionSettings settings;
    int samples; ///< samples of each pixel; 0: unknown
    bool has_gradients, has_variances, has_features, has_halves, has_brightest, is_demodulated;
    std::size_t components;
    float patch;

    FitKey(const GradientImages& images, const ReconstructionSettings& settings_)
        : settings(settings_), samples(images.brightest.samples), has_gradients(images.has_gradients()),
          has_variances(images.has_variances()), has_features(!images.features.empty()),
          has_halves(!images.halves.empty()), has_brightest(!images.brightest.empty()),
          is_demodulated(!images.demodulation.empty()), components(images.components.size()), patch(images.patch) {
    }

    /// Returns whether a fit serves `later`, with less than a quarter more samples, which reduce noise by a tenth.
    bool serves(FitKey later) const {
        const bool is_near = later.samples >= samples && 4 * later.samples < 5 * samples;
        later.samples = samples;
        return is_near && later == *this;
    }
    /// Returns whether it can serve a picture with one sample more: of fewer than five samples, one is a quarter
    /// or more.
    bool can_serve() const { return samples > 4; }
    bool operator==(const FitKey&) const = default;
};

} // namespace

struct Reconstructor::KeptFit {
    FitKey key;
    GuidedFit fit{};

    bool is_whole() const { return !key.has_features || !key.has_halves || !fit.filter.empty(); }
};

Reconstructor::Reconstructor() = default;
Reconstructor::~Reconstructor() = default;

void Reconstructor::forget() {
    has_solved_ = false;
    kept_.reset();
    if (solvers_)
        solvers_->forget();
}

void Reconstructor::set_keeps(bool keeps) {
    keeps_ = keeps;
    if (!keeps)
        kept_.reset();
}

void Reconstructor::set_parameters(const GuidedParameters& parameters) {
    parameters_ = parameters;
    forget();
}

std::uint64_t Reconstructor::bytes_for(const ReconstructionSize& size, Norm norm) const {
    const std::uint64_t image = sizeof(Rgb) * static_cast<std::uint64_t>(size.width) * size.height;
    const PictureSolvers none(size.width, size.height);
    const bool has_some = solvers_ && solvers_->width() == size.width && solvers_->height() == size.height;
    const std::uint64_t solvers = (has_some ? *solvers_ : none).bytes_for(norm, size.threads, size.components);
    const std::uint64_t remodulation = size.is_demodulated ? bytes_to_remodulate(size.width, size.height) : 0;
    switch (norm) {
    case Norm::guided:
    case Norm::smoothed:
        return 2 * image + solvers + remodulation +
               bytes_for_guided(size.width, size.height, size.has_gradients, size.is_demodulated);
    case Norm::oidn:
        return 6 * image + bytes_of_oidn(size.width, size.height);
    case Norm::weighted:
        return image + solvers + EdgeWeights::bytes(size.width, size.height) +
               4 * sizeof(float) * image / sizeof(Rgb);
    case Norm::none:
        return image;
    default:
        return 2 * image + solvers;
    }
}

std::uint64_t Reconstructor::bytes_to_keep(int width, int height) {
    return (GuidedFit::bytes_a_pixel + FeatureKernels::bytes_a_pixel) * static_cast<std::uint64_t>(width) *
               height +
           EdgeWeights::bytes(width, height);
}

std::uint64_t Reconstructor::bytes_kept() const {
    return kept_ ? kept_->fit.bytes() : 0;
}

/// Makes the picture of `guided` or `smoothed`, and keeps its fit for the next.
Reconstruction Reconstructor::denoise(const GradientImages& images, const ReconstructionSettings& settings,
                                      const ParallelFor& parallel_for, const SolveWatch& watch) {
    const FitKey key(images, settings);
    const bool is_fitted = kept_ && kept_->key.serves(key);
    auto fit = is_fitted ? std::move(kept_) : std::make_unique<KeptFit>(KeptFit{key});
    kept_.reset();
    const float alpha = settings.norm == Norm::guided ? settings.alpha : 0;
    GuidedPicture made =
        Guided(images, alpha, parameters_, *solvers_, fit->fit, is_fitted, parallel_for, watch).picture();
    if (!made.image.empty() && keeps_ && has_solved_ && fit->key.can_serve() && fit->is_whole())
        kept_ = std::move(fit);
    return {.image = std::move(made.image),
            .iterations = made.iterations,
            .redistributed = made.redistributed,
            .goes_on = is_fitted};
}

/// Makes the picture of a published reconstruction from raw samples.
Reconstruction Reconstructor::publish(const GradientImages& images, const ReconstructionSettings& settings,
                                      const ParallelFor& parallel_for, const SolveWatch& watch) {
    Reconstruction result;
    if (settings.norm == Norm::none) {
        result.image = copy_of(images.radiance(), parallel_for);
    } else if (settings.norm == Norm::oidn) {
        result.image = denoised_by_oidn(images.radiance(), images.features);
    } else {
        const SolveStats stats =
            solvers_->solve(images, settings.norm, settings.alpha, result.image, parallel_for, watch);
        result.residual = stats.residual;
        result.iterations = stats.iterations;
        if (!images.demodulation.empty() && !result.image.empty())
            recombine(images, result.image, parallel_for);
    }
    return result;
}

Reconstruction Reconstructor::reconstruct(const GradientImages& images, const ReconstructionSettings& asked,
                                          const ParallelFor& parallel_for, const SolveWatch& watch) {
    const auto start = std::chrono::steady_clock::now();
    check_sizes(images);
    ReconstructionSettings settings = asked;
    settings.norm = applied(asked.norm, images.has_gradients());
    if (settings.norm != Norm::none && !(settings.alpha > 0))
        throw std::invalid_argument("the reconstruction's alpha must be above 0");
    const int width = images.primal.width(), height = images.primal.height();
    if (!solvers_ || solvers_->width() != width || solvers_->height() != height) {
        forget();
        solvers_ = std::make_unique<PictureSolvers>(width, height);
    }
    if (settings.norm != Norm::guided)
        solvers_->forget_halves(); // their last solution would be outdated when it is needed
    const bool is_denoised = settings.norm == Norm::guided || settings.norm == Norm::smoothed;
    if (!is_denoised)
        kept_.reset();
    Reconstruction result = is_denoised ? denoise(images, settings, parallel_for, watch)
                                        : publish(images, settings, parallel_for, watch);
    if (!result.image.empty()) {
        for_pixels(images.very_direct.width(), images.very_direct.height(), parallel_for,
                   [&](std::size_t i) { result.image.data()[i] += images.very_direct.data()[i]; });
        has_solved_ = true;
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    return Reconstructor().reconstruct(images, settings, parallel_for, watch);
}

} // namespace tessera
