#include "recon/guided/upper_bounds.h"

#include "recon/guided/demodulation.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr float largest = 1e30f; // of variances, so that sums stay finite

/// Returns s, reconstruction (62). Means are of roots of s, because a few bright pixels would decide a mean of s.
Plane standard_errors(const Image<float>& variances, const FeatureKernels& kernels,
                      const GuidedParameters& parameters, const ParallelFor& parallel_for) {
    const auto own = [&](std::size_t i) { return std::sqrt(std::min(variances.data()[i], largest)); };
    Plane errors(variances.width(), variances.height(), Unfilled());
    for_pixels(errors.width(), errors.height(), parallel_for,
               [&](std::size_t i) { errors.data()[i] = std::sqrt(own(i)); });
    kernels.take_means(parameters.bound_levels, errors, parallel_for);
    for_pixels(errors.width(), errors.height(), parallel_for, [&](std::size_t i) {
        float& error = errors.data()[i];
        error = std::max(own(i), error * error);
    });
    return errors;
}

/// Returns the fraction of the pixels of the square around each in which a sample found light.
Image<float> lit_fractions(const RgbImage& radiance, int radius, const ParallelFor& parallel_for) {
    Image<float> lit(radiance.width(), radiance.height(), Unfilled());
    for_pixels(lit.width(), lit.height(), parallel_for,
               [&](std::size_t i) { lit.data()[i] = radiance.data()[i] == Rgb(0) ? 0.0f : 1.0f; });
    Image<float> rows(lit.width(), lit.height(), Unfilled());
    take_wide_means(lit, radius, rows, parallel_for);
    return lit;
}

} // namespace

bool can_bound(const GradientImages& images) {
    return images.patch > 1 && !images.primal_variance.empty() && images.components.empty();
}

RgbImage upper_bounds(const GradientImages& images, const FeatureKernels& kernels,
                      const GuidedParameters& parameters, const ParallelFor& parallel_for) {
    const Plane errors = standard_errors(images.primal_variance, kernels, parameters, parallel_for);
    const Image<float> lit = lit_fractions(images.radiance(), parameters.noise_radius, parallel_for);
    RgbImage bounds = copy_of(images.primal, parallel_for);
    const bool is_demodulated = !images.demodulation.empty();
    if (is_demodulated)
        remodulate(images, parameters, bounds, parallel_for);
    for_pixels(bounds.width(), bounds.height(), parallel_for, [&](std::size_t i) {
        const Rgb albedo = is_demodulated ? images.demodulation.sampled_albedo.data()[i] : Rgb(1);
        const Rgb own = glm::max(bounds.data()[i], glm::max(images.radiance().data()[i], Rgb(0)));
        bounds.data()[i] = lit.data()[i] < parameters.bound_lit
                               ? Rgb(std::numeric_limits<float>::infinity())
                               : own + parameters.bound_reach * errors.data()[i] * albedo;
    });
    return bounds;
}

} // namespace tessera
