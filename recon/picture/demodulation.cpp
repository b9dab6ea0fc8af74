#include "recon/picture/demodulation.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

Rgb known_albedo(const Demodulation& d, int x, int y) {
    return d.albedo(x, y) + d.sampled_share(x, y) * (d.sampled_albedo(x, y) - d.albedo(x, y));
}

void multiply_by_known_albedo(const Demodulation& d, RgbImage& image, const ParallelFor& parallel_for) {
    parallel_for(d.empty() ? 0 : image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x)
            image(x, y) *= known_albedo(d, x, y);
    });
}

namespace {

/// V = A E + m(v) - A m(e), of pixel (x, y).
Rgb unbiased(const GradientImages& images, const RgbImage& image, int x, int y) {
    const Demodulation& d = images.demodulation;
    return d.value(x, y) + d.albedo(x, y) * (image(x, y) - images.primal(x, y));
}

/// The sum over the pixels of the 3x3 about (x, y).
template <class Sum, class ValueOf>
Sum around(int x, int y, int width, int height, ValueOf value_of) {
    Sum sum(0);
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
            sum += value_of(i, j);
    return sum;
}

/// b: how v changes with a, in the samples of the pixels around; as little as they know of it, it is E.
Rgb slope(const GradientImages& images, Rgb light, int x, int y) {
    constexpr float prior = 0.1f;  // of a pixel's variance
    constexpr float least = 1e-4f; // of the squared albedo: below, differences say nothing, and may be rounding
    const Demodulation& d = images.demodulation;
    const auto sum = [&](const RgbImage& image) {
        return around<Rgb>(x, y, image.width(), image.height(), [&](int i, int j) { return image(i, j); });
    };
    const Rgb albedo = known_albedo(d, x, y);
    const Rgb weight = prior * d.albedo_variance(x, y) / 3 + least * albedo * albedo;
    return (sum(d.value_covariance) + weight * light) / glm::max(sum(d.sampled_variance) + weight, 1e-20f);
}

/// rho = m(v) - A m(e) - b (m(a) - A).
Rgb covariance(const GradientImages& images, Rgb light, int x, int y) {
    const Demodulation& d = images.demodulation;
    const Rgb albedo = known_albedo(d, x, y);
    return d.value(x, y) - albedo * images.primal(x, y) -
           slope(images, light, x, y) * (d.sampled_albedo(x, y) - albedo);
}

/// k of pixel (x, y).
float trust(const GradientImages& images, const RgbImage& rho, int x, int y) {
    const Demodulation& d = images.demodulation;
    // As if each channel had a third of both variances.
    const double noise = around<double>(x, y, rho.width(), rho.height(), [&](int i, int j) {
        return static_cast<double>(d.albedo_variance(i, j)) * static_cast<double>(d.unexplained_variance(i, j)) /
               3;
    });
    const double squares = around<double>(x, y, rho.width(), rho.height(), [&](int i, int j) {
        const glm::dvec3 r(rho(i, j));
        return glm::dot(r, r);
    });
    return squares > 0 ? static_cast<float>(std::max(0.0, 1 - noise / squares)) : 0;
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
    if (!images.primal_variance.empty()) {
        rho = RgbImage(width, height);
        parallel_for(height, [&](int y) {
            for (int x = 0; x < width; ++x)
                rho(x, y) = covariance(images, image(x, y), x, y);
        });
    }
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) *= known_albedo(d, x, y);
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
