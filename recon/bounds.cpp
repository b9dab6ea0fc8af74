#include "recon/bounds.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace tessera {

namespace {

constexpr float reach = 2;           // bounds in standard errors
constexpr int radius = 2;            // of the squares of pixels that are asked
constexpr float least_share = 1e-6f; // of the mean around, that a variance counts as at least
constexpr float most = 1e30f, least = 1e-30f; // of variances: sums of 25 stay finite, and so do logarithms

/// Means over the squares of 5x5 pixels, as far as these are within the image.
Image<float> means_around(const Image<float>& values, const ParallelFor& parallel_for) {
    const int width = values.width(), height = values.height();
    Image<float> rows(width, height), means(width, height);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - radius, 0), right = std::min(x + radius, width - 1);
            float sum = 0;
            for (int i = left; i <= right; ++i)
                sum += values(i, y);
            rows(x, y) = sum / static_cast<float>(right - left + 1);
        }
    });
    parallel_for(height, [&](int y) {
        const int top = std::max(y - radius, 0), bottom = std::min(y + radius, height - 1);
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int j = top; j <= bottom; ++j)
                sum += rows(x, j);
            means(x, y) = sum / static_cast<float>(bottom - top + 1);
        }
    });
    return means;
}

/// s^2 of the primal, summed over the channels.
Image<float> squared_errors(const Image<float>& variances, const ParallelFor& parallel_for) {
    const int width = variances.width(), height = variances.height();
    Image<float> own(width, height);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            own(x, y) = std::min(variances(x, y), most);
    });
    Image<float> around = means_around(own, parallel_for);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            around(x, y) = std::log(std::max(own(x, y) + least_share * around(x, y), least));
    });
    around = means_around(around, parallel_for);
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            own(x, y) = std::max(own(x, y), std::exp(around(x, y)));
    });
    return own;
}

/// s of the radiance in each channel: with v = a e of every sample, that of e, and what the samples' own albedos vary
/// by.
Rgb standard_error(const GradientImages& images, float squared_error, int x, int y) {
    const Demodulation& d = images.demodulation;
    if (d.empty())
        return Rgb(std::sqrt(squared_error));
    const Rgb a = d.sampled_albedo(x, y), e = images.primal(x, y);
    const auto samples = static_cast<float>(std::max(images.brightest.samples, 1));
    return glm::sqrt(a * a * squared_error + e * e * d.sampled_variance(x, y) / samples);
}

} // namespace

bool can_bound(const GradientImages& images) {
    return images.patch > 1 && !images.primal_variance.empty() && images.parts.empty();
}

void keep_within_bounds(const GradientImages& images, RgbImage& image, const ParallelFor& parallel_for) {
    const Image<float> squares = squared_errors(images.primal_variance, parallel_for);
    const RgbImage& own = images.radiance();
    parallel_for(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgb s = reach * standard_error(images, squares(x, y), x, y);
            image(x, y) = glm::clamp(image(x, y), own(x, y) - s, own(x, y) + s);
        }
    });
}

} // namespace tessera
