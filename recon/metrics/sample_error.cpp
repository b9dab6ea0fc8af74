#include "recon/metrics/sample_error.h"

#include "recon/guided/demodulation.h"
#include "recon/parallel.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tessera {

namespace {

constexpr int radius = 2;

/// Returns the half differences as radiance; 0 where they or the picture are not finite.
RgbImage noise_of(const GradientImages& images, const RgbImage& picture) {
    RgbImage noise = images.halves.primal;
    multiply_by_known_albedo(images.demodulation, noise, serial_for);
    std::transform(noise.begin(), noise.end(), picture.begin(), noise.begin(),
                   [](const Rgb& n, const Rgb& p) { return is_finite(n) && is_finite(p) ? n : Rgb(0); });
    return noise;
}

/// Returns means over squares of max(sign * channel, 0); 0 for values that are not finite.
Image<float> means_of(const RgbImage& image, int channel, float sign, Image<float>& rows) {
    constexpr float largest = 1e30f; // sums of some dozens stay finite
    Image<float> means(image.width(), image.height());
    std::transform(image.begin(), image.end(), means.begin(), [=](const Rgb& c) {
        return std::isfinite(c[channel]) ? std::clamp(sign * c[channel], 0.0f, largest) : 0.0f;
    });
    take_wide_means(means, radius, rows, serial_for);
    return means;
}

} // namespace

std::optional<FloorFreeError> estimate_sample_error(const GradientImages& images, const RgbImage& picture) {
    constexpr double most_unknown = 0.2;
    const int width = picture.width(), height = picture.height();
    if (images.halves.empty() || picture.empty() || images.halves.primal.width() != width ||
        images.halves.primal.height() != height)
        return std::nullopt;
    const RgbImage noise = noise_of(images, picture);
    Image<double> errors(width, height);
    Image<float> rows(width, height);
    double unknown = 0;
    for (int c = 0; c < 3; ++c) {
        const Image<float> brightness = means_of(picture, c, 1, rows);
        const Image<float> above = means_of(noise, c, 1, rows), below = means_of(noise, c, -1, rows);
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const auto mean = static_cast<double>(brightness.data()[i]);
            const auto h = static_cast<double>(noise.data()[i][c]);
            const auto of_mean = static_cast<double>(above.data()[i] - below.data()[i]);
            const double square = mean * mean + relative_mse_epsilon;
            errors.data()[i] += h * h / square / 3;
            unknown += std::min(of_mean * of_mean / square, 1.0) / 3;
        }
    }
    if (unknown > most_unknown * static_cast<double>(errors.size()))
        return std::nullopt;
    return mean_of_pieces(errors);
}

} // namespace tessera
