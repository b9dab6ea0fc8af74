#include "recon/edge_weights.h"

#include <algorithm>
#include <vector>

namespace tessera {

namespace {

// The best of what was tried on Veach, Ajar and Country Kitchen, G-PT and G-PR, 32 samples a pixel.
constexpr float noise_factor = 0.4f; // k
constexpr int gradient_radius = 2, primal_radius = 4;
constexpr float own_share = 0.5f; // of a gradient's own variance against the mean around

constexpr float largest_variance = 1e30f; // sums of some dozens stay finite

/// The mean of values over the squares of edge 2 radius + 1 around each pixel, as far as something is measured
/// there: not in the last `columns` and `rows`, where the means are 0, too.
Image<float> mean_around(const Image<float>& values, int radius, int columns, int rows,
                         const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> means(values.width(), values.height());
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
            means(x, y) = sum / static_cast<float>((right - left + 1) * (bottom - top + 1));
        }
    });
    return means;
}

float weight(float alpha, float own_variance, float variance_around, float primal_variance) {
    const float least = alpha * alpha * primal_variance;
    const float variance =
        own_share * std::min(own_variance, largest_variance) + (1 - own_share) * variance_around;
    const float noise = noise_factor * variance;
    return noise > 0 ? least / (least + noise) : 1;
}

} // namespace

EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const ParallelFor& parallel_for) {
    const int width = images.primal.width(), height = images.primal.height();
    const Image<float> primal = mean_around(images.primal_variance, primal_radius, 0, 0, parallel_for);
    const Image<float> dx = mean_around(images.dx_variance, gradient_radius, 1, 0, parallel_for);
    const Image<float> dy = mean_around(images.dy_variance, gradient_radius, 0, 1, parallel_for);
    EdgeWeights weights{Image<float>(width, height), Image<float>(width, height)};
    parallel_for(height, [&](int y) {
        for (int x = 0; x + 1 < width; ++x)
            weights.x(x, y) =
                weight(alpha, images.dx_variance(x, y), dx(x, y), (primal(x, y) + primal(x + 1, y)) / 2);
        if (y + 1 < height)
            for (int x = 0; x < width; ++x)
                weights.y(x, y) =
                    weight(alpha, images.dy_variance(x, y), dy(x, y), (primal(x, y) + primal(x, y + 1)) / 2);
    });
    return weights;
}

} // namespace tessera
