#include "recon/demodulation.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// V = A E + m(v) - A m(e), of pixel (x, y).
Rgb unbiased(const GradientImages& images, const RgbImage& image, int x, int y) {
    const Demodulation& d = images.demodulation;
    return d.value(x, y) + d.albedo(x, y) * (image(x, y) - images.primal(x, y));
}

/// The mean of all albedos that are known of a pixel.
Rgb albedo_of(const Demodulation& d, int x, int y) {
    return d.albedo(x, y) + d.sampled_share(x, y) * (d.sampled_albedo(x, y) - d.albedo(x, y));
}

/// rho = m((a - A) (e - E)) = m(v) - A m(e) - E (m(a) - A).
Rgb covariance(const GradientImages& images, const RgbImage& image, int x, int y) {
    const Demodulation& d = images.demodulation;
    const Rgb albedo = albedo_of(d, x, y);
    return d.value(x, y) - albedo * images.primal(x, y) - image(x, y) * (d.sampled_albedo(x, y) - albedo);
}

/// Of rho, summed over the channels, as if each had a third of both variances: that of a, and that of the mean of
/// e.
double variance_of_covariance(const GradientImages& images, int x, int y) {
    const double a = images.demodulation.albedo_variance(x, y), e = images.primal_variance(x, y);
    return a * e / 3;
}

/// k of pixel (x, y).
float trust(const GradientImages& images, const RgbImage& rho, int x, int y) {
    double noise = 0, squares = 0;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rho.height() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, rho.width() - 1); ++i) {
            noise += variance_of_covariance(images, i, j);
            squares += static_cast<double>(glm::dot(rho(i, j), rho(i, j)));
        }
    return squares > 0 ? static_cast<float>(std::max(0.0, 1 - 2 * noise / squares)) : 0;
}

} // namespace

void remodulate(const GradientImages& images, bool is_unbiased, RgbImage& image, const ParallelFor& parallel_for) {
    const Demodulation& d = images.demodulation;
    const int width = image.width(), height = image.height();
    if (is_unbiased) {
        parallel_for(height, [&](int y) {
            for (int x = 0; x < width; ++x)
                image(x, y) = unbiased(images, image, x, y);
        });
        return;
    }
    RgbImage rho;
    if (!images.primal_variance.empty() && !d.albedo_variance.empty()) {
        rho = RgbImage(width, height);
        parallel_for(height, [&](int y) {
            for (int x = 0; x < width; ++x)
                rho(x, y) = covariance(images, image, x, y);
        });
    }
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) *= albedo_of(d, x, y);
            if (!rho.empty())
                image(x, y) += trust(images, rho, x, y) * rho(x, y);
        }
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
