#include "recon/picture/spikes.h"

#include "recon/picture/light_spreader.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// A sample may weigh so much in its pixel's mean, in means of the others; and may be so many times as large as
/// these in any case. Tried on caustics and rooms with 2 to 64 samples: 1/8 to 1/2 are nearly level.
constexpr float share = 0.25f, least_factor = 2;

/// So much of the mean of a pixel's own others counts, where it is more than the mean around: features of one
/// pixel, whose samples agree, are no spikes. In full it would let through what two samples of the pixel found.
constexpr float own_share = 0.5f;

/// How large the mean of the samples is without the brightest.
float size_of_others(const RgbImage& mean, const RgbImage& brightest, std::size_t i, float n) {
    return n / (n - 1) * size_of(mean.data()[i] - brightest.data()[i] / n);
}

/// What the other samples say of the primals of pixels: of each, and as a mean over 3x3 pixels. (Beyond 3e37 that
/// is no number any more, and nothing around is limited.)
struct Others {
    Image<float> own, around;

    Others(const GradientImages& images, const ParallelFor& parallel_for)
        : own(images.primal.width(), images.primal.height(), Unfilled()) {
        const BrightestSamples& b = images.brightest;
        const auto n = static_cast<float>(b.samples);
        for_pixels(own.width(), own.height(), parallel_for,
                   [&](std::size_t i) { own.data()[i] = size_of_others(images.primal, b.primal, i, n); });
        around = square_means(own, 1, 0, 0, parallel_for);
    }
};

/// t of a pixel's primal and of its gradients.
struct Limits {
    float primal = 1, gradients = 1;
};

/// Of pixel i. Where a spike lights the neighbour alone, gradients are limited, and the primal is not.
Limits limits_of(const GradientImages& images, const Others& others, std::size_t i) {
    const BrightestSamples& b = images.brightest;
    const auto n = static_cast<float>(b.samples);
    const float factor = std::max(least_factor, share * n);
    const auto limit = [factor](float size, float mu) {
        constexpr float rounding = 1e-6f; // where all samples of a bright pixel are alike, both sides are
        return size > factor * mu * (1 + rounding) ? factor * mu / size : 1;
    };
    float mu = std::max(others.around.data()[i], own_share * others.own.data()[i]);
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

/// A mean of n samples when x, one of them, counts as t x.
void limit(Rgb& mean, glm::dvec3 x, double t, double n) {
    mean = Rgb(glm::dvec3(mean) - (1 - t) * x / n);
}

/// What is left of the variance of the mean of n samples when x, one of them, counts as t x, over all of it.
double share_of_variance(glm::dvec3 mean, glm::dvec3 x, double variance, double t, double n) {
    const glm::dvec3 others = (n * mean - x) / (n - 1), now = t * x - others;
    const double all = variance * n * (n - 1);
    const double rest = std::max(all - glm::dot(x - mean, x - mean) * n / (n - 1), 0.0);
    return all > 0 ? std::min((rest + glm::dot(now, now) * (n - 1) / n) / all, 1.0) : 1;
}

/// What depends on the limited samples of pixel i of the images, in those of `result`. With v = a e of the sample,
/// m(v) and cov(a, v) lack (1 - t) v / n and that times a - m(a): exactly, as the deviations from m(a) sum to
/// zero. Of the variance that a does not explain is left what is left of all; the others, which solvers ask how
/// far a pixel is to be trusted, stay those of all samples.
void limit_demodulation(const GradientImages& images, std::size_t i, double t, glm::dvec3 held,
                        GradientImages& result) {
    const BrightestSamples& b = images.brightest;
    Demodulation& d = result.demodulation;
    const glm::dvec3 a(b.albedo.data()[i]), mean_a(d.sampled_albedo.data()[i]);
    d.value.data()[i] = Rgb(glm::dvec3(d.value.data()[i]) - held);
    d.value_covariance.data()[i] = Rgb(glm::dvec3(d.value_covariance.data()[i]) - held * (a - mean_a));
    if (!images.primal_variance.empty())
        d.unexplained_variance.data()[i] *= static_cast<float>(
            share_of_variance(glm::dvec3(images.primal.data()[i]), glm::dvec3(b.primal.data()[i]),
                              static_cast<double>(images.primal_variance.data()[i]), t, b.samples));
}

/// What is held back of pixel i with t.
glm::dvec3 held_of(const BrightestSamples& b, std::size_t i, double t) {
    const glm::dvec3 a = b.albedo.empty() ? glm::dvec3(1) : glm::dvec3(b.albedo.data()[i]);
    return (1 - t) / b.samples * a * glm::dvec3(b.primal.data()[i]);
}

/// The half differences lack as much of the sample, with its weight in them.
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

template <class Visit>
void for_each_limited(const GradientImages& images, const ParallelFor& parallel_for, Visit&& visit) {
    const Others others(images, parallel_for);
    for_pixels(images.primal.width(), images.primal.height(), parallel_for, [&](std::size_t i) {
        if (const Limits t = limits_of(images, others, i); t.primal < 1 || t.gradients < 1)
            visit(i, t);
    });
}

/// What a picture is made of as far as limits change it, and what is needed beside that; of the brightest samples,
/// which halves they are in.
GradientImages copied(const GradientImages& images, bool with_halves, const ParallelFor& parallel_for) {
    const auto copy = [&](const auto& image) { return copy_of(image, parallel_for); };
    const Demodulation& d = images.demodulation;
    GradientImages result{copy(images.primal), copy(images.dx), copy(images.dy), {}};
    result.primal_variance = copy(images.primal_variance);
    result.dx_variance = copy(images.dx_variance);
    result.dy_variance = copy(images.dy_variance);
    result.demodulation = {
        copy(d.value),         copy(d.albedo),           copy(d.sampled_albedo),   copy(d.albedo_variance),
        copy(d.sampled_share), copy(d.sampled_variance), copy(d.value_covariance), copy(d.unexplained_variance)};
    if (with_halves) {
        result.brightest.half = copy(images.brightest.half);
        result.halves = {copy(images.halves.primal), copy(images.halves.dx), copy(images.halves.dy)};
    }
    result.patch = images.patch;
    return result;
}

} // namespace

bool can_limit(const GradientImages& images) {
    return !images.brightest.empty() && images.brightest.samples > 1 && images.parts.empty();
}

GradientImages limited(const GradientImages& images, bool with_halves, RgbImage& held,
                       const ParallelFor& parallel_for) {
    const BrightestSamples& b = images.brightest;
    held = filled_image(images.primal.width(), images.primal.height(), Rgb(0), parallel_for);
    GradientImages result = copied(images, with_halves, parallel_for);
    for_each_limited(images, parallel_for, [&](std::size_t i, Limits t) {
        const double n = b.samples;
        limit_halves(result.halves, b, i, t);
        if (images.has_gradients()) {
            limit(result.dx.data()[i], b.dx.data()[i], t.gradients, n);
            limit(result.dy.data()[i], b.dy.data()[i], t.gradients, n);
        }
        if (t.primal == 1)
            return;
        const glm::dvec3 back = held_of(b, i, t.primal);
        held.data()[i] = Rgb(back);
        limit(result.primal.data()[i], b.primal.data()[i], t.primal, n);
        if (!images.demodulation.empty())
            limit_demodulation(images, i, t.primal, back, result);
    });
    return result;
}

RgbImage held_light(const GradientImages& images) {
    RgbImage held(images.primal.width(), images.primal.height(), Rgb(0));
    if (can_limit(images))
        for_each_limited(images, serial_for, [&](std::size_t i, Limits t) {
            held.data()[i] = Rgb(held_of(images.brightest, i, t.primal));
        });
    return held;
}

std::size_t bytes_to_limit(bool has_gradients, bool is_demodulated) {
    const std::size_t copies = (has_gradients ? 3 : 1) * sizeof(Rgb) + (has_gradients ? 3 : 1) * sizeof(float) +
                               (is_demodulated ? Demodulation::bytes_a_pixel : 0) + sizeof(float) +
                               HalfDifferences::bytes_a_pixel;
    // Two images of light to be spread, two of the bounds and the room below them, and which pixels are black.
    return copies + 5 * sizeof(Rgb) + sizeof(std::uint8_t) + bytes_to_spread_a_pixel;
}

} // namespace tessera
