#include "recon/metrics/halo.h"

#include "recon/guided/fireflies.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

constexpr double mean_fraction = 0.01; // of the mean luminance, added to a pixel's luminance

/// Replaces the sample x of a mean of n samples, and x itself, by the mean of the others. The variance (null:
/// unknown) changes accordingly: with S the sum of squares, it is (S - n mean^2) / (n (n - 1)).
void replace(Rgb& mean, float* variance, Rgb& sample, int samples) {
    const double n = samples;
    const glm::dvec3 m(mean), x(sample), others = (n * m - x) / (n - 1);
    if (variance) {
        const double squares = n * (n - 1) * static_cast<double>(*variance) + n * glm::dot(m, m) - glm::dot(x, x) +
                               glm::dot(others, others);
        *variance = static_cast<float>(std::max(0.0, (squares - n * glm::dot(others, others)) / (n * (n - 1))));
    }
    mean = sample = Rgb(others);
}

float* at(Image<float>& variances, std::size_t i) {
    return variances.empty() ? nullptr : variances.data() + i;
}

/// Replaces the brightest sample x by the mean of the others in the half differences.
void replace_in_halves(RgbImage& half, const RgbImage& mean, const RgbImage& x, const BrightestSamples& b,
                       std::size_t i) {
    if (half.empty() || b.half.empty())
        return;
    const double n = b.samples;
    const glm::dvec3 sample(x.data()[i]), others = (n * glm::dvec3(mean.data()[i]) - sample) / (n - 1);
    const double weight = static_cast<double>(b.half.data()[i]) / n;
    half.data()[i] = Rgb(glm::dvec3(half.data()[i]) - weight * (sample - others));
}

void replace_primal(GradientImages& images, std::size_t i) {
    BrightestSamples& b = images.brightest;
    replace_in_halves(images.halves.primal, images.primal, b.primal, b, i);
    const glm::dvec3 old_mean(images.primal.data()[i]);
    replace(images.primal.data()[i], at(images.primal_variance, i), b.primal.data()[i], b.samples);
    Demodulation& d = images.demodulation;
    if (d.empty())
        return;
    const glm::dvec3 a(b.albedo.data()[i]), removed = a * (old_mean - glm::dvec3(images.primal.data()[i]));
    d.value.data()[i] = Rgb(glm::dvec3(d.value.data()[i]) - removed);
    d.value_covariance.data()[i] =
        Rgb(glm::dvec3(d.value_covariance.data()[i]) - removed * (a - glm::dvec3(d.sampled_albedo.data()[i])));
}

double light_of(const GradientImages& images, std::size_t i) {
    return static_cast<double>(luminance(images.radiance().data()[i]));
}

/// Returns the luminance by which the brightest sample raises the radiance of pixel i.
double excess(const GradientImages& images, std::size_t i) {
    const BrightestSamples& b = images.brightest;
    const double n = b.samples;
    const glm::dvec3 a = b.albedo.empty() ? glm::dvec3(1) : glm::dvec3(b.albedo.data()[i]);
    const glm::dvec3 x(b.primal.data()[i]), mean(images.primal.data()[i]);
    return static_cast<double>(luminance(Rgb(a * (x - mean) / (n - 1)))); // (x - mean of others) / n
}

} // namespace

GradientImages without_brightest(const GradientImages& images, PixelRect square) {
    GradientImages result = images;
    BrightestSamples& b = result.brightest;
    const PixelRect inside = square.clipped({images.primal.width(), images.primal.height()});
    // Gradients of the pixels to the left of the square and above it lead into it.
    for (int y = std::max(inside.y0 - 1, 0); y < inside.y1; ++y)
        for (int x = std::max(inside.x0 - 1, 0); x < inside.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(images.primal.width()) +
                           static_cast<std::size_t>(x);
            if (images.has_gradients()) {
                replace_in_halves(result.halves.dx, result.dx, b.dx, b, i);
                replace_in_halves(result.halves.dy, result.dy, b.dy, b, i);
                replace(result.dx.data()[i], at(result.dx_variance, i), b.dx.data()[i], b.samples);
                replace(result.dy.data()[i], at(result.dy_variance, i), b.dy.data()[i], b.samples);
            }
            if (inside.contains({x, y}))
                replace_primal(result, i);
        }
    return result;
}

std::optional<Halo> measure_halo(const GradientImages& images, const ReconstructionSettings& settings,
                                 const ParallelFor& parallel_for) {
    if (!can_clamp(images))
        return {};
    std::size_t brightest = 0;
    for (std::size_t i = 1; i < images.primal.size(); ++i)
        if (excess(images, i) > excess(images, brightest))
            brightest = i;
    if (!(excess(images, brightest) > 0))
        return {};
    const int width = images.primal.width();
    const int reach = static_cast<int>(std::lround(images.patch)) + (images.has_gradients() ? 1 : 0);
    Halo halo{{static_cast<int>(brightest) % width, static_cast<int>(brightest) / width}};
    const PixelRect square{halo.firefly.x - reach + 1, halo.firefly.y - reach + 1, halo.firefly.x + reach,
                           halo.firefly.y + reach};
    if (square.clipped({width, images.primal.height()}) == PixelRect{0, 0, width, images.primal.height()})
        return {};
    const GradientImages without = without_brightest(images, square);
    const RgbImage with_spike = reconstruct(images, settings, parallel_for).image;
    const RgbImage picture = reconstruct(without, settings, parallel_for).image;
    double mean = 0, own = 0, outside = 0;
    for (Rgb c : picture)
        mean += static_cast<double>(luminance(c)) / static_cast<double>(picture.size());
    if (!(mean > 0))
        return {};
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const glm::ivec2 pixel(static_cast<int>(i) % width, static_cast<int>(i) / width);
        if (square.contains(pixel)) {
            own += light_of(images, i) - light_of(without, i);
            continue;
        }
        const double change = std::abs(static_cast<double>(luminance(with_spike.data()[i] - picture.data()[i])));
        const double brightness = std::max(static_cast<double>(luminance(picture.data()[i])), 0.0);
        outside += change;
        if (change > 0)
            halo.peak = std::max(halo.peak, change / (brightness + mean_fraction * mean));
    }
    halo.energy = own > 0 ? outside / own : 0;
    return halo;
}

} // namespace tessera
