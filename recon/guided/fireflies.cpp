#include "recon/guided/fireflies.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Returns o of reconstruction (57), the luminance of the mean of a pixel's samples other than the brightest.
float size_of_others(const RgbImage& mean, const RgbImage& brightest, std::size_t i, float n) {
    return n / (n - 1) * size_of(mean.data()[i] - brightest.data()[i] / n);
}

/// Returns the mean of o over 3x3 pixels. It is infinite where luminances exceed 3e37; nothing is clamped there.
Image<float> others_around(const GradientImages& images, const ParallelFor& parallel_for) {
    Image<float> own(images.primal.width(), images.primal.height(), Unfilled());
    const auto n = static_cast<float>(images.brightest.samples);
    for_pixels(own.width(), own.height(), parallel_for, [&](std::size_t i) {
        own.data()[i] = size_of_others(images.primal, images.brightest.primal, i, n);
    });
    return square_means(own, 1, 0, 0, parallel_for);
}

/// Factors t of a pixel's primal and of its gradients, reconstruction (56).
struct Limits {
    float primal = 1, gradients = 1;
};

/// Returns the factors of pixel i. A firefly of a neighbour alone clamps the gradients and not the primal.
Limits limits_of(const GradientImages& images, float others, const GuidedParameters& parameters, std::size_t i) {
    const BrightestSamples& b = images.brightest;
    const auto n = static_cast<float>(b.samples);
    const float factor = std::max(parameters.firefly_factor, parameters.firefly_fraction * n);
    const auto limit = [factor](float size, float mu) {
        constexpr float rounding = 1e-6f; // both sides are equal if all samples of the pixel are
        return size > factor * mu * (1 + rounding) ? factor * mu / size : 1;
    };
    float mu = std::max(others, parameters.firefly_own * size_of_others(images.primal, b.primal, i, n));
    float size = size_of(b.primal.data()[i]);
    Limits limits{limit(size, mu)};
    if (!images.has_gradients())
        return limits;
    for (const auto& [mean, brightest] : {std::pair(&images.dx, &b.dx), std::pair(&images.dy, &b.dy)}) {
        mu = std::max(mu, size_of_others(*mean, *brightest, i, n));
        size = std::max(size, size_of(brightest->data()[i]));
    }
    limits.gradients = limit(size, mu);
    return limits;
}

/// Replaces one sample x of a mean of n samples by t x.
void limit(Rgb& mean, glm::dvec3 x, double t, double n) {
    mean = Rgb(glm::dvec3(mean) - (1 - t) * x / n);
}

/// Returns the variance of the mean of n samples after one sample x becomes t x, over the variance before.
double fraction_of_variance(glm::dvec3 mean, glm::dvec3 x, double variance, double t, double n) {
    const glm::dvec3 others = (n * mean - x) / (n - 1), deviation = t * x - others;
    const double all = variance * n * (n - 1);
    const double rest = std::max(all - glm::dot(x - mean, x - mean) * n / (n - 1), 0.0);
    return all > 0 ? std::min((rest + glm::dot(deviation, deviation) * (n - 1) / n) / all, 1.0) : 1;
}

/// Applies the clamp to the demodulation of pixel i in `result`. With v = a e of the sample, m(v) loses (1 - t) v
/// / n, and cov(a, v) loses that times a - m(a). This is exact, since the deviations from m(a) sum to 0. The
/// variance that a does not explain shrinks as the variance does. Other variances stay those of the raw samples.
void limit_demodulation(const GradientImages& images, std::size_t i, double t, glm::dvec3 removed,
                        GradientImages& result) {
    const BrightestSamples& b = images.brightest;
    Demodulation& d = result.demodulation;
    const glm::dvec3 a(b.albedo.data()[i]), mean_a(d.sampled_albedo.data()[i]);
    d.value.data()[i] = Rgb(glm::dvec3(d.value.data()[i]) - removed);
    d.value_covariance.data()[i] = Rgb(glm::dvec3(d.value_covariance.data()[i]) - removed * (a - mean_a));
    if (!images.primal_variance.empty())
        d.unexplained_variance.data()[i] *= static_cast<float>(
            fraction_of_variance(glm::dvec3(images.primal.data()[i]), glm::dvec3(b.primal.data()[i]),
                                 static_cast<double>(images.primal_variance.data()[i]), t, b.samples));
}

/// Returns H of reconstruction (58), the mean radiance that pixel i loses with t.
glm::dvec3 removed_of(const BrightestSamples& b, std::size_t i, double t) {
    const glm::dvec3 a = b.albedo.empty() ? glm::dvec3(1) : glm::dvec3(b.albedo.data()[i]);
    return (1 - t) / b.samples * a * glm::dvec3(b.primal.data()[i]);
}

/// Clamps the sample in the half differences, where it is weighted by b.half.
void limit_halves(HalfDifferences& halves, const BrightestSamples& b, std::size_t i, Limits t) {
    if (halves.empty() || b.half.empty())
        return;
    const double n = b.samples, weight = static_cast<double>(b.half.data()[i]);
    limit(halves.primal.data()[i], weight * glm::dvec3(b.primal.data()[i]), t.primal, n);
    if (halves.dx.empty())
        return;
    limit(halves.dx.data()[i], weight * glm::dvec3(b.dx.data()[i]), t.gradients, n);
    limit(halves.dy.data()[i], weight * glm::dvec3(b.dy.data()[i]), t.gradients, n);
}

/// Calls visit(i, limits) for the pixels with a firefly.
template <class Visit>
void for_each_firefly(const GradientImages& images, const GuidedParameters& parameters,
                      const ParallelFor& parallel_for, Visit&& visit) {
    const Image<float> others = others_around(images, parallel_for);
    for_pixels(images.primal.width(), images.primal.height(), parallel_for, [&](std::size_t i) {
        if (const Limits t = limits_of(images, others.data()[i], parameters, i); t.primal < 1 || t.gradients < 1)
            visit(i, t);
    });
}

/// Copies the images that clamping changes, and the variances and settings that later stages need.
GradientImages copy_for_clamping(const GradientImages& images, const ParallelFor& parallel_for) {
    const auto copy = [&](const auto& image) { return copy_of(image, parallel_for); };
    const Demodulation& d = images.demodulation;
    GradientImages result{copy(images.primal), copy(images.dx), copy(images.dy), {}};
    result.primal_variance = copy(images.primal_variance);
    result.dx_variance = copy(images.dx_variance);
    result.dy_variance = copy(images.dy_variance);
    result.demodulation = {
        copy(d.value),          copy(d.albedo),           copy(d.sampled_albedo),   copy(d.albedo_variance),
        copy(d.sampled_weight), copy(d.sampled_variance), copy(d.value_covariance), copy(d.unexplained_variance)};
    result.halves = {copy(images.halves.primal), copy(images.halves.dx), copy(images.halves.dy)};
    result.patch = images.patch;
    return result;
}

} // namespace

bool can_clamp(const GradientImages& images) {
    return !images.brightest.empty() && images.brightest.samples > 1 && images.components.empty();
}

ClampedSamples clamp_fireflies(const GradientImages& images, const GuidedParameters& parameters,
                               const ParallelFor& parallel_for) {
    const BrightestSamples& b = images.brightest;
    ClampedSamples result{copy_for_clamping(images, parallel_for),
                          filled_image(images.primal.width(), images.primal.height(), Rgb(0), parallel_for)};
    GradientImages& changed = result.images;
    for_each_firefly(images, parameters, parallel_for, [&](std::size_t i, Limits t) {
        const double n = b.samples;
        limit_halves(changed.halves, b, i, t);
        if (images.has_gradients()) {
            limit(changed.dx.data()[i], b.dx.data()[i], t.gradients, n);
            limit(changed.dy.data()[i], b.dy.data()[i], t.gradients, n);
        }
        if (t.primal == 1)
            return;
        const glm::dvec3 removed = removed_of(b, i, t.primal);
        result.clamped.data()[i] = Rgb(removed);
        limit(changed.primal.data()[i], b.primal.data()[i], t.primal, n);
        if (!images.demodulation.empty())
            limit_demodulation(images, i, t.primal, removed, changed);
    });
    return result;
}

RgbImage clamped_radiance(const GradientImages& images) {
    RgbImage clamped(images.primal.width(), images.primal.height(), Rgb(0));
    if (can_clamp(images))
        for_each_firefly(images, {}, serial_for, [&](std::size_t i, Limits t) {
            clamped.data()[i] = Rgb(removed_of(images.brightest, i, t.primal));
        });
    return clamped;
}

std::size_t bytes_to_clamp(bool has_gradients, bool is_demodulated) {
    const std::size_t images = has_gradients ? 3 : 1;
    return images * (sizeof(Rgb) + sizeof(float)) + (is_demodulated ? Demodulation::bytes_a_pixel : 0) +
           HalfDifferences::bytes_a_pixel + sizeof(Rgb) + 2 * sizeof(float);
}

} // namespace tessera
