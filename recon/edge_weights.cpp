#include "recon/edge_weights.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

// The best of what was tried on Veach, Ajar, Country Kitchen and Bathroom, G-PT and G-PR, 16 samples a pixel.
// Larger squares and a smaller k let dark pixels beside noisy bright ones lose their light; a larger k leaves the
// noise of rare paths.
constexpr float noise_factor = 0.8f; // k
constexpr int gradient_radius = 1, primal_radius = 2;
constexpr float gradient_share = 0.5f, primal_share = 0.2f; // of the own variance against the mean around

constexpr float largest_variance = 1e30f; // sums of some dozens stay finite

/// Variances where nobody has measured them, from how much the values differ in the square of 3x3 pixels around
/// each: the sample variance, summed over the channels. What the picture itself varies by counts as noise. Like
/// those that are measured, they are 0 in the last `columns` and `rows`.
Image<float> variances_from_neighbours(const RgbImage& values, int columns, int rows,
                                       const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> variances(values.width(), values.height());
    parallel_for(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            double squares = 0, n = 0;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i, ++n) {
                    const glm::dvec3 value(values(i, j));
                    sum += value;
                    squares += glm::dot(value, value);
                }
            const double spread = squares - glm::dot(sum, sum) / n; // below 0 by rounding alone
            if (n > 1)
                variances(x, y) = static_cast<float>(std::clamp(spread / (n - 1), 0.0, double(largest_variance)));
        }
    });
    return variances;
}

/// Each value blended with the mean over the square of edge 2 radius + 1 around its pixel, as far as something is
/// measured there: not in the last `columns` and `rows`, where the result is 0, too.
Image<float> blended(const Image<float>& values, float own_share, int radius, int columns, int rows,
                     const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> blend(values.width(), values.height());
    parallel_for(height, [&](int y) {
        std::vector<float> sums(static_cast<std::size_t>(width)); // sums of the columns of the squares
        const int top = std::max(y - radius, 0), bottom = std::min(y + radius, height - 1);
        for (int row = top; row <= bottom; ++row)
            for (int x = 0; x < width; ++x)
                sums[x] += std::min(values(x, row), largest_variance);
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - radius, 0), right = std::min(x + radius, width - 1);
            float sum = 0;
            for (int i = left; i <= right; ++i)
                sum += sums[i];
            const float mean = sum / static_cast<float>((right - left + 1) * (bottom - top + 1));
            blend(x, y) = own_share * std::min(values(x, y), largest_variance) + (1 - own_share) * mean;
        }
    });
    return blend;
}

/// The weight of a gradient between two pixels. Where one has far less noise than the other, as a dark pixel
/// beside a lamp's edge, it needs the gradient least, and would take the other's noise: what counts is the
/// geometric mean.
float weight(float alpha, float gradient_variance, float one_primal_variance, float other_primal_variance) {
    const float primal_variance = std::sqrt(one_primal_variance) * std::sqrt(other_primal_variance);
    const float least = alpha * alpha * primal_variance, noise = noise_factor * gradient_variance;
    return noise > 0 ? least / (least + noise) : 1;
}

} // namespace

EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    const int width = images.primal.width(), height = images.primal.height();
    const bool is_measured = images.has_variances();
    const auto noise = [&](const RgbImage& values, const Image<float>& measured, float own_share, int radius,
                           int columns, int rows) {
        const Image<float> around =
            is_measured ? Image<float>() : variances_from_neighbours(values, columns, rows, parallel_for);
        return blended(is_measured ? measured : around, own_share, radius, columns, rows, parallel_for);
    };
    const Image<float> primal = noise(images.primal, images.primal_variance, primal_share, primal_radius, 0, 0);
    const Image<float> dx = noise(images.dx, images.dx_variance, gradient_share, gradient_radius, 1, 0);
    const Image<float> dy = noise(images.dy, images.dy_variance, gradient_share, gradient_radius, 0, 1);
    EdgeWeights weights{Image<float>(width, height), Image<float>(width, height)};
    parallel_for(height, [&](int y) {
        for (int x = 0; x + 1 < width; ++x)
            weights.x(x, y) = weight(alpha, dx(x, y), primal(x, y), primal(x + 1, y));
        if (y + 1 < height)
            for (int x = 0; x < width; ++x)
                weights.y(x, y) = weight(alpha, dy(x, y), primal(x, y), primal(x, y + 1));
    });
    return weights;
}

} // namespace tessera
