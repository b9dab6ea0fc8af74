#include "recon/guided/demodulation.h"

#include "recon/pixel_loops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

Rgb known_albedo(const Demodulation& d, int x, int y) {
    return d.albedo(x, y) + d.sampled_weight(x, y) * (d.sampled_albedo(x, y) - d.albedo(x, y));
}

void multiply_by_known_albedo(const Demodulation& d, RgbImage& image, const ParallelFor& parallel_for) {
    parallel_for(d.empty() ? 0 : image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x)
            image(x, y) *= known_albedo(d, x, y);
    });
}

namespace {

/// Returns the sums over the 3x3 pixels around each pixel of row y.
template <class Sum, class ValueOf>
std::vector<Sum> sums_around(int y, int width, int height, ValueOf value_of) {
    std::vector<Sum> columns(static_cast<std::size_t>(width) + 2, Sum(0)), sums(static_cast<std::size_t>(width));
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int x = 0; x < width; ++x)
            columns[static_cast<std::size_t>(x) + 1] += value_of(x, j);
    for (std::size_t x = 0; x < sums.size(); ++x)
        sums[x] = columns[x] + columns[x + 1] + columns[x + 2];
    return sums;
}

/// S_va and S_aa of reconstruction (46): sums over 3x3 pixels of the (co)variances over each pixel's samples.
struct SlopeSums {
    Rgb covariance, variance; ///< S_va, S_aa
};

/// Returns b of reconstruction (46), the slope of v over a. The prior E has more weight where V_a exceeds the
/// variance of the samples: neighbours whose albedo hardly changes say nothing of this pixel.
Rgb slope(const GradientImages& images, const SlopeSums& sums, float prior, Rgb light, int x, int y) {
    constexpr float least = 1e-4f; // relative to A^2: smaller differences may be rounding
    constexpr float most = 1e10f;  // keeps products finite, whatever a file holds
    const Demodulation& d = images.demodulation;
    const Rgb albedo = known_albedo(d, x, y);
    const float trace = sums.variance.r + sums.variance.g + sums.variance.b;
    const float variance = std::min(d.albedo_variance(x, y), most);
    const float excess = std::clamp(variance / std::max(trace, 1 / most), 1.0f, most);
    const Rgb weight = prior * excess * variance / 3 + least * albedo * albedo;
    return (sums.covariance + weight * light) / glm::max(sums.variance + weight, 1e-20f);
}

/// Writes rho = m(v) - A m(e) - b (m(a) - A) of row y, reconstruction (45).
void write_covariance(const GradientImages& images, const RgbImage& light, float prior, int y, RgbImage& rho) {
    const Demodulation& d = images.demodulation;
    const int width = light.width();
    const auto sums_of = [&](const RgbImage& image) {
        return sums_around<Rgb>(y, width, light.height(), [&](int x, int j) { return image(x, j); });
    };
    const std::vector<Rgb> covariances = sums_of(d.value_covariance), variances = sums_of(d.sampled_variance);
    for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(x);
        const Rgb albedo = known_albedo(d, x, y);
        rho(x, y) = d.value(x, y) - albedo * images.primal(x, y) -
                    slope(images, {covariances[i], variances[i]}, prior, light(x, y), x, y) *
                        (d.sampled_albedo(x, y) - albedo);
    }
}

/// Returns k of the pixels of row y, reconstruction (47). The noise is a squared mean of roots: in a mean of
/// squares one noisy pixel would hide the covariance of all pixels around.
std::vector<float> trust(const GradientImages& images, const RgbImage& rho, int y) {
    const Demodulation& d = images.demodulation;
    const auto sums = sums_around<glm::dvec3>(y, rho.width(), rho.height(), [&](int x, int j) {
        const glm::dvec3 r(rho(x, j));
        // Each channel is taken to have a third of both variances.
        const double noise =
            static_cast<double>(d.albedo_variance(x, j)) * static_cast<double>(d.unexplained_variance(x, j)) / 3;
        return glm::dvec3(std::sqrt(std::max(noise, 0.0)), glm::dot(r, r), 1);
    });
    std::vector<float> result(sums.size());
    std::ranges::transform(sums, result.begin(), [](const glm::dvec3& sum) {
        const double noise = sum[0] * sum[0] / sum[2];
        return sum[1] > 0 ? static_cast<float>(std::max(0.0, 1 - noise / sum[1])) : 0.0f;
    });
    return result;
}

} // namespace

void recombine(const GradientImages& images, RgbImage& image, const ParallelFor& parallel_for) {
    const Demodulation& d = images.demodulation;
    for_pixels(image.width(), image.height(), parallel_for, [&](std::size_t i) {
        image.data()[i] = d.value.data()[i] + d.albedo.data()[i] * (image.data()[i] - images.primal.data()[i]);
    });
}

void remodulate(const GradientImages& images, const GuidedParameters& parameters, RgbImage& image,
                const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    RgbImage rho;
    if (!images.primal_variance.empty() && parameters.stages.covariance) {
        rho = RgbImage(width, height, Unfilled());
        parallel_for(height, [&](int y) { write_covariance(images, image, parameters.slope_prior, y, rho); });
    }
    multiply_by_known_albedo(images.demodulation, image, parallel_for);
    parallel_for(rho.height(), [&](int y) {
        const std::vector<float> k = trust(images, rho, y);
        for (int x = 0; x < width; ++x)
            image(x, y) += k[x] * rho(x, y);
    });
}

std::uint64_t bytes_to_remodulate(int width, int height) {
    return sizeof(Rgb) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

RgbImage sample_covariance(const GradientImages& images) {
    const Demodulation& d = images.demodulation;
    RgbImage result(d.value.width(), d.value.height());
    for (std::size_t i = 0; i < result.size(); ++i)
        result.data()[i] = d.value.data()[i] - d.sampled_albedo.data()[i] * images.primal.data()[i];
    return result;
}

} // namespace tessera
