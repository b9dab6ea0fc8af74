#include "recon/picture/edge_weights.h"

#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

// The best of what was tried on Veach, Ajar, Country Kitchen, Bathroom and The Grey & White Room, G-PR, 4 and 15
// samples a pixel. A larger k leaves the noise of rare paths.
constexpr float noise_factor = 0.5f;    // k
constexpr std::size_t alike_levels = 2; // of AlikePixels, for the primal: pixels within 8
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

/// How bright pixels are, beside which variances are looked at.
struct Brightness {
    float mean = 1;                         ///< of the picture; 1: all count as equally bright
    float most_relative = largest_variance; ///< no variance over the squares is more
    Image<float> squares;                   ///< of brightness over the mean, and a little

    /// @param is_known  false: of one sample, which is dark by chance where others are bright
    Brightness(const RgbImage& primal, bool is_known, const ParallelFor& parallel_for)
        : squares(primal.width(), primal.height(), Unfilled()) {
        constexpr float largest = 1e4f; // squares stay finite
        const auto brightness = [&](std::size_t i) { return brightness_of(primal.data()[i]); };
        const double sum = sum_over_pixels(primal.width(), primal.height(), parallel_for, brightness);
        const auto mean_of_all = static_cast<float>(sum / static_cast<double>(primal.size()));
        const bool is_lit = is_known && mean_of_all > 0 && std::isfinite(mean_of_all);
        if (is_lit) {
            mean = mean_of_all;
            // Of a mean to which one sample has brought all, the sum over the channels of a grey. Beyond it are
            // pixels whose spikes are held back while their variances are not.
            most_relative = 3;
        }
        for_pixels(primal.width(), primal.height(), parallel_for, [&](std::size_t i) {
            const float b = is_lit ? std::min(brightness(i) / mean, largest) + dark : 1;
            squares.data()[i] = b * b;
        });
    }

    /// Beside which the variance at (x, y) is looked at: of a gradient, both pixels' squares.
    float scale(int x, int y, int columns, int rows) const {
        return squares(x, y) + (columns + rows > 0 ? squares(x + columns, y + rows) : 0.0f);
    }
};

/// Variances over the squares of the brightness; anything in the last `columns` and `rows`.
Image<float> relative(const Image<float>& variances, const Brightness& brightness, int columns, int rows,
                      const ParallelFor& parallel_for) {
    Image<float> result(variances.width(), variances.height(), Unfilled());
    parallel_for(variances.height() - rows, [&](int y) {
        for (int x = 0; x + columns < variances.width(); ++x) {
            const float variance = std::min(variances(x, y), largest_variance) / brightness.mean / brightness.mean;
            result(x, y) = std::min(variance / brightness.scale(x, y, columns, rows), brightness.most_relative);
        }
    });
    return result;
}

/// Blends relative variances with their means around, which become variances in units of the mean's square.
void blend(const Image<float>& own, float own_share, const Brightness& brightness, int columns, int rows,
           const ParallelFor& parallel_for, Image<float>& around) {
    parallel_for(own.height() - rows, [&](int y) {
        for (int x = 0; x + columns < own.width(); ++x) {
            const float both = own_share * own(x, y) + (1 - own_share) * around(x, y);
            around(x, y) = both * brightness.scale(x, y, columns, rows);
        }
    });
}

/// The weight of a gradient between two pixels. Where one has far less noise than the other, as a dark pixel
/// beside a lamp's edge, it needs the gradient least, and would take the other's noise: its own counts.
float weight(float alpha, float k, float gradient_variance, float one_primal_variance,
             float other_primal_variance) {
    const float least = alpha * alpha * std::min(one_primal_variance, other_primal_variance),
                noise = k * gradient_variance;
    return noise > 0 ? least / (least + noise) : 1;
}

/// V of the primal, blended with those of pixels that look alike.
/// @param alike  null, or nothing measured: with those of squares
Image<float> primal_noise(const GradientImages& images, const Brightness& brightness, const AlikePixels* alike,
                          const ParallelFor& parallel_for) {
    const bool is_measured = images.has_variances();
    const Image<float> guessed =
        is_measured ? Image<float>() : variances_from_neighbours(images.primal, 0, 0, parallel_for);
    const Image<float> own =
        relative(is_measured ? images.primal_variance : guessed, brightness, 0, 0, parallel_for);
    Image<float> around;
    if (alike && is_measured) {
        around = copy_of(own, parallel_for);
        alike->take_means(alike_levels, around, parallel_for);
    } else {
        around = square_means(own, primal_radius, 0, 0, parallel_for);
    }
    blend(own, primal_share, brightness, 0, 0, parallel_for, around);
    return around;
}

/// V of gradients, blended with those around; 0 in the last `columns` and `rows`, where nothing is measured.
/// @param measured  empty: by nobody
Image<float> gradient_noise(const RgbImage& gradients, const Image<float>& measured, const Brightness& brightness,
                            int columns, int rows, const ParallelFor& parallel_for) {
    const Image<float> guessed =
        measured.empty() ? variances_from_neighbours(gradients, columns, rows, parallel_for) : Image<float>();
    const Image<float> own =
        relative(measured.empty() ? guessed : measured, brightness, columns, rows, parallel_for);
    Image<float> around = square_means(own, gradient_radius, columns, rows, parallel_for);
    blend(own, gradient_share, brightness, columns, rows, parallel_for, around);
    return around;
}

/// What `gradients` (the whole's, or a part's) are to be trusted beside the whole's primal.
template <class Gradients>
EdgeWeights weights_of(const GradientImages& images, const Gradients& gradients, float alpha,
                       const AlikePixels* alike, const ParallelFor& parallel_for) {
    const int width = images.primal.width(), height = images.primal.height();
    const bool is_measured = images.has_variances();
    const Brightness brightness(images.primal, is_measured, parallel_for);
    const Image<float> primal = primal_noise(images, brightness, alike, parallel_for);
    const Image<float> none;
    const Image<float> dx =
        gradient_noise(gradients.dx, is_measured ? gradients.dx_variance : none, brightness, 1, 0, parallel_for);
    const Image<float> dy =
        gradient_noise(gradients.dy, is_measured ? gradients.dy_variance : none, brightness, 0, 1, parallel_for);
    const float k = noise_factor / std::sqrt(images.patch);
    EdgeWeights weights{Image<float>(width, height, Unfilled()), Image<float>(width, height, Unfilled())};
    parallel_for(height, [&](int y) {
        weights.x(width - 1, y) = 0;
        for (int x = 0; x + 1 < width; ++x)
            weights.x(x, y) = weight(alpha, k, dx(x, y), primal(x, y), primal(x + 1, y));
        for (int x = 0; x < width; ++x)
            weights.y(x, y) = y + 1 < height ? weight(alpha, k, dy(x, y), primal(x, y), primal(x, y + 1)) : 0;
    });
    return weights;
}

} // namespace

EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const AlikePixels* alike,
                                 const ParallelFor& parallel_for) {
    return weights_of(images, images, alpha, alike, parallel_for);
}

EdgeWeights weights_of_part(const GradientImages& images, const CoefficientPart& part, float alpha,
                            const ParallelFor& parallel_for) {
    return weights_of(images, part, alpha, nullptr, parallel_for);
}

} // namespace tessera
