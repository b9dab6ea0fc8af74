#include "recon/solvers/edge_weights.h"

#include "recon/local_brightness.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr float largest_variance = 1e30f; // sums of some dozens stay finite

/// Returns the sample variance of the values of 3x3 pixels, summed over the channels, as an estimate of each
/// variance. Detail of the picture counts as noise. The last `columns` and `rows`, where gradients are undefined,
/// are 0.
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
            const double spread = squares - glm::dot(sum, sum) / n; // negative only by rounding
            if (n > 1)
                variances(x, y) = static_cast<float>(std::clamp(spread / (n - 1), 0.0, double(largest_variance)));
        }
    });
    return variances;
}

/// Squared brightness B that variances are relative to, reconstruction (40).
struct Brightness {
    Image<float> squares; ///< (b + dark L)^2

    /// @param is_measured  false: no variances; B = 1
    Brightness(const RgbImage& primal, bool is_measured, const GuidedParameters& parameters,
               const ParallelFor& parallel_for)
        : squares(primal.width(), primal.height(), Unfilled()) {
        if (!is_measured) {
            squares = filled_image(primal.width(), primal.height(), 1.0f, parallel_for);
            return;
        }
        for_pixels(primal.width(), primal.height(), parallel_for,
                   [&](std::size_t i) { squares.data()[i] = brightness_of(primal.data()[i]); });
        const Image<float> around =
            local_mean_brightness(copy_of(squares, parallel_for), parameters.local_radius, parallel_for);
        for_pixels(primal.width(), primal.height(), parallel_for, [&](std::size_t i) {
            constexpr float largest = 1e15f; // squares stay finite
            const float b = std::min(squares.data()[i], largest) +
                            std::min(parameters.dark * around.data()[i], largest) + 1 / largest;
            squares.data()[i] = b * b;
        });
    }

    /// Returns B at (x, y), or for a gradient the sum of B of both pixels.
    float scale(int x, int y, int columns, int rows) const {
        return squares(x, y) + (columns + rows > 0 ? squares(x + columns, y + rows) : 0.0f);
    }
};

/// Divides variances by B. The last `columns` and `rows` are undefined.
Image<float> relative(const Image<float>& variances, const Brightness& brightness, int columns, int rows,
                      const ParallelFor& parallel_for) {
    Image<float> result(variances.width(), variances.height(), Unfilled());
    parallel_for(variances.height() - rows, [&](int y) {
        for (int x = 0; x + columns < variances.width(); ++x) {
            const float variance = std::min(variances(x, y), largest_variance);
            result(x, y) = std::min(variance / brightness.scale(x, y, columns, rows), largest_variance);
        }
    });
    return result;
}

/// Returns w of reconstruction (38), for a primal of weight alpha^2.
float weight(float alpha, float k, float gradient_variance, float one_primal_variance,
             float other_primal_variance) {
    const float primal = alpha * alpha * std::min(one_primal_variance, other_primal_variance),
                noise = k * gradient_variance;
    return noise > 0 ? primal / (primal + noise) : 1;
}

/// Returns V of reconstruction (40), for an image or its gradients; 0 in the last `columns` and `rows`, where
/// gradients are undefined.
/// @param measured  sample variances; empty: estimated from neighbours
Image<float> variances_around(const RgbImage& values, const Image<float>& measured, int radius,
                              const Brightness& brightness, int columns, int rows,
                              const ParallelFor& parallel_for) {
    const Image<float> estimated =
        measured.empty() ? variances_from_neighbours(values, columns, rows, parallel_for) : Image<float>();
    const Image<float> own =
        relative(measured.empty() ? estimated : measured, brightness, columns, rows, parallel_for);
    Image<float> around = square_means(own, radius, columns, rows, parallel_for);
    parallel_for(own.height() - rows, [&](int y) {
        for (int x = 0; x + columns < own.width(); ++x)
            around(x, y) *= brightness.scale(x, y, columns, rows);
    });
    return around;
}

/// Returns the weights of `gradients` (of the whole, or of a component) against the whole's primal.
template <class Gradients>
EdgeWeights weights_of(const GradientImages& images, const Gradients& gradients, float alpha,
                       const GuidedParameters& parameters, const ParallelFor& parallel_for) {
    const int width = images.primal.width(), height = images.primal.height();
    const bool is_measured = images.has_variances();
    const Image<float> none;
    const Brightness brightness(images.primal, is_measured, parameters, parallel_for);
    const auto variances = [&](const RgbImage& values, const Image<float>& measured, int radius, int columns,
                               int rows) {
        return variances_around(values, is_measured ? measured : none, radius, brightness, columns, rows,
                                parallel_for);
    };
    const Image<float> primal = variances(images.primal, images.primal_variance, parameters.primal_radius, 0, 0);
    const Image<float> dx = variances(gradients.dx, gradients.dx_variance, parameters.gradient_radius, 1, 0);
    const Image<float> dy = variances(gradients.dy, gradients.dy_variance, parameters.gradient_radius, 0, 1);
    const float k = parameters.edge_noise / std::sqrt(images.patch);
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

EdgeWeights weights_of_gradients(const GradientImages& images, float alpha, const GuidedParameters& parameters,
                                 const ParallelFor& parallel_for) {
    return weights_of(images, images, alpha, parameters, parallel_for);
}

EdgeWeights weights_of_component(const GradientImages& images, const BasisComponent& component, float alpha,
                                 const ParallelFor& parallel_for) {
    return weights_of(images, component, alpha, {}, parallel_for);
}

} // namespace tessera
