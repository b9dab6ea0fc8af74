#include "recon/guided/guided.h"

#include "recon/guided/demodulation.h"
#include "recon/guided/upper_bounds.h"
#include "recon/local_brightness.h"
#include "recon/pixel_loops.h"
#include "recon/solvers/edge_weights.h"
#include "recon/solvers/picture_solvers.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

std::uint64_t GuidedFit::bytes() const {
    const auto bytes_of = [](const auto& image) -> std::uint64_t { return image.size() * sizeof(*image.data()); };
    std::uint64_t sum = (kernels ? kernels->bytes() : 0) + bytes_of(weights.x) + bytes_of(weights.y) +
                        bytes_of(local) + bytes_of(nearby.brightness) + bytes_of(nearby.around) +
                        bytes_of(filter.regression_trust);
    for (std::size_t l = 0; l < FilterFit::most_levels; ++l) {
        sum += bytes_of(filter.trust[l]);
        for (const Image<PairWeight>& level : filter.weights[l])
            sum += bytes_of(level);
    }
    return sum;
}

GuidedPicture Guided::picture() {
    clamp_samples();
    find_features();
    RgbImage picture = solve();
    if (picture.empty())
        return {};
    remodulate(picture);
    redistribute(picture);
    if (can_filter())
        filter(picture);
    if (watch_.is_stopped() || picture.empty())
        return {};
    limit(picture);
    finish(picture);
    const double clamped_energy = sum_of_sizes(clamped_.clamped, parallel_for_),
                 energy = clamped_energy > 0 ? sum_of_sizes(raw_.radiance(), parallel_for_) : 0;
    return {std::move(picture), energy > 0 ? clamped_energy / energy : 0, iterations_};
}

void Guided::clamp_samples() {
    if (parameters_.stages.fireflies && can_clamp(raw_))
        clamped_ = clamp_fireflies(raw_, parameters_, parallel_for_);
}

void Guided::find_features() {
    if (!is_fitted_)
        fit_.kernels.emplace(glm::ivec2(raw_.primal.width(), raw_.primal.height()), raw_.features, parameters_,
                             parallel_for_);
}

/// Stage 3. Returns the picture of the coefficient, or of the radiance without a basis. Empty: stopped.
RgbImage Guided::solve() {
    if (!solves())
        return copy_of(images().primal, parallel_for_);
    const float alpha = weighted_alpha(alpha_, images().patch, parameters_);
    if (!is_fitted_)
        fit_.weights = parameters_.stages.edge_weights
                           ? weights_of_gradients(images(), alpha, parameters_, parallel_for_)
                           : EdgeWeights::ones(raw_.primal.width(), raw_.primal.height());
    RgbImage picture;
    iterations_ =
        solvers_.solve_weighted(images(), alpha, fit_.weights, is_fitted_, picture, parallel_for_, watch_);
    return watch_.is_stopped() ? RgbImage() : std::move(picture);
}

/// Stage 4. Raises radiance below min(m(v), 0) to it, since solvers go below black beside strong edges.
void Guided::remodulate(RgbImage& picture) const {
    if (!images().demodulation.empty())
        tessera::remodulate(images(), parameters_, picture, parallel_for_);
    const RgbImage& primal = images().radiance();
    for_pixels(picture.width(), picture.height(), parallel_for_, [&](std::size_t i) {
        picture.data()[i] = glm::max(picture.data()[i], glm::min(primal.data()[i], Rgb(0)));
    });
}

void Guided::redistribute(RgbImage& picture) {
    if (!is_fitted_) {
        fit_.local = Image<float>(picture.width(), picture.height(), Unfilled());
        for_pixels(picture.width(), picture.height(), parallel_for_, [&](std::size_t i) {
            fit_.local.data()[i] =
                brightness_of(picture.data()[i] / feature_albedo(raw_.features, i, parameters_.least_albedo));
        });
        fit_.local = local_mean_brightness(std::move(fit_.local), parameters_.local_radius, parallel_for_);
    }
    if (clamped_.clamped.empty() || !parameters_.stages.redistribution)
        return;
    fit_.nearby = tessera::redistribute(copy_of(clamped_.clamped, parallel_for_), *fit_.kernels, raw_.features,
                                        fit_.local, parameters_, parallel_for_, picture);
}

/// Returns the noise N of the picture, as radiance: the solver's answer for the half differences, plus the
/// redistributed energy with its sign in the half differences.
RgbImage Guided::noise() {
    RgbImage noise;
    if (solves())
        solvers_.solve_halves(images(), weighted_alpha(alpha_, images().patch, parameters_), fit_.weights, noise,
                              parallel_for_, watch_);
    else
        noise = copy_of(images().halves.primal, parallel_for_);
    multiply_by_known_albedo(images().demodulation, noise, parallel_for_);
    if (fit_.nearby.empty() || raw_.brightest.half.empty())
        return noise;
    RgbImage clamped(noise.width(), noise.height(), Unfilled());
    for_pixels(clamped.width(), clamped.height(), parallel_for_, [&](std::size_t i) {
        clamped.data()[i] = clamped_.clamped.data()[i] * raw_.brightest.half.data()[i];
    });
    spread_around(clamped, fit_.nearby, parameters_, parallel_for_, noise);
    return noise;
}

/// Stages 6 and 7. Leaves an empty picture if stopped.
void Guided::filter(RgbImage& picture) {
    NoisyPicture noisy{std::move(picture), {}};
    if (!is_fitted_)
        noisy.noise = noise();
    picture = watch_.is_stopped() ? RgbImage()
                                  : tessera::filter(std::move(noisy), raw_.features, *fit_.kernels, fit_.local,
                                                    parameters_, fit_.filter, parallel_for_, watch_)
                                        .image;
}

/// Stage 8.
void Guided::limit(RgbImage& picture) const {
    if (!parameters_.stages.bounds || !can_bound(images()))
        return;
    const RgbImage bounds = upper_bounds(images(), *fit_.kernels, parameters_, parallel_for_);
    for_pixels(picture.width(), picture.height(), parallel_for_,
               [&](std::size_t i) { picture.data()[i] = glm::min(picture.data()[i], bounds.data()[i]); });
}

/// Raises radiance below min(m(v), 0) to it, and blackens pixels that see no surface and in which no sample found
/// light.
void Guided::finish(RgbImage& picture) const {
    const bool has_features = !raw_.features.empty();
    const RgbImage& primal = images().radiance();
    for_pixels(picture.width(), picture.height(), parallel_for_, [&](std::size_t i) {
        picture.data()[i] = glm::max(picture.data()[i], glm::min(primal.data()[i], Rgb(0)));
        if (has_features && raw_.features.nearness.data()[i] == 0 && raw_.radiance().data()[i] == Rgb(0))
            picture.data()[i] = Rgb(0);
    });
}

std::uint64_t bytes_for_guided(int width, int height, bool has_gradients, bool is_demodulated) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * height;
    const std::uint64_t samples = bytes_to_clamp(has_gradients, is_demodulated) + 2 * sizeof(Rgb);
    const std::uint64_t stages =
        std::max<std::uint64_t>(bytes_to_redistribute * pixels, bytes_to_filter(width, height));
    return (samples + FeatureKernels::bytes_a_pixel + GuidedFit::bytes_a_pixel) * pixels +
           EdgeWeights::bytes(width, height) + stages;
}

} // namespace tessera
