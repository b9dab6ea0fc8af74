// Errors of images against a reference, or against two independent references.
#pragma once

#include "recon/image.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Keeps the relative errors of dark pixels finite: the epsilon of [Bauszat 2017, 4], a squared radiance.
inline constexpr double relative_mse_epsilon = 0.001;

/// Keeps the relative errors of dark pixels finite in MAPE: a radiance.
inline constexpr double mape_epsilon = 0.01;

/// Errors of an image I against a reference r. Means are over pixels and their three channels.
struct ErrorMetrics {
    double relative_mse = 0;         ///< mean of (I - r)^2 / (r^2 + relative_mse_epsilon)
    double relative_mse_trimmed = 0; ///< the same without the worst 0.01 % of the pixels (rounded down)
    double mse = 0;                  ///< mean of (I - r)^2
    double mape = 0;                 ///< mean of |I - r| / (|r| + mape_epsilon); 1 is 100 %
    double mean_ratio = 0;           ///< mean of I over mean of r
    std::size_t bad_pixels = 0;      ///< pixels of I that are not finite; if > 0, other errors are not finite
};

/// Returns all errors. Throws std::invalid_argument if the sizes differ or the images are empty.
ErrorMetrics measure_error(const RgbImage& image, const RgbImage& reference);

/// Sum of the values of a square piece of an image, and its number of pixels.
struct Piece {
    double sum = 0;
    double pixels = 0;
};

/// Returns the pieces of an image, row by row: squares with an edge of `edge` pixels, smaller at the right and the
/// bottom.
std::vector<Piece> pieces_of(const Image<double>& values, int edge);

/// Estimate of the relative MSE to a noiseless reference, from two noisy ones.
struct FloorFreeError {
    double relative_mse = 0; ///< mean of (I - r1)(I - r2) / (r^2 + epsilon), r = (r1 + r2) / 2
    /// Standard error of relative_mse, from the variance over pieces of 16x16 pixels (over pixels in small
    /// images).
    double standard_error = 0;
};

/// Returns that estimate. The noise of two independent references does not correlate, so that their products
/// vanish in the mean: an image equal to the truth has the expected value 0. A bias remains, since r^2 is noisy
/// too. It is of the order of the fourth power of the references' relative noise: 1.5e-4 for 10 %. Throws as
/// measure_error() does.
FloorFreeError measure_floor_free_error(const RgbImage& image, const RgbImage& reference1,
                                        const RgbImage& reference2);

/// Returns the relative error of mean luminance, mean of I over mean of r minus 1, for each quarter of the pixels
/// from the darkest to the brightest. Each reference sorts the pixels once while the other is compared: pixels
/// that are sorted as dark by a reference are too dark in it by chance. Not finite for a quarter that is empty, or
/// black in a reference. Throws as measure_error() does.
std::array<double, 4> measure_energy_change(const RgbImage& image, const RgbImage& reference1,
                                            const RgbImage& reference2);

/// Returns the error of the mean r of two independent references, from their difference:
///   mean of ((r1 - r2) / 2)^2 / (r^2 + epsilon).
/// A bias that both have, as from a reconstruction, is not in it. Throws as measure_error() does.
FloorFreeError measure_reference_error(const RgbImage& reference1, const RgbImage& reference2);

// Per-pixel maps of these errors, each the mean of three channels. They throw as measure_error() does.
Image<double> floor_free_errors(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);
Image<double> reference_errors(const RgbImage& reference1, const RgbImage& reference2);
/// Returns the mean of such a map, and its standard error.
FloorFreeError mean_of_pieces(const Image<double>& errors);

/// Slope of a line in a log-log chart, and an upper limit of its standard error: points of one render have samples
/// in common, so that their errors may be correlated in any way.
struct Slope {
    double value, error;
};

/// Returns the exponent b of y ~ x^b by least squares of the logarithms: -1 for an error that falls as variance
/// does. Points with a coordinate that is not positive and finite are left out. Returns NaN for fewer than two
/// different x.
/// @param relative_errors  standard error of each y, over y; empty: the slope's error is NaN
Slope log_log_slope(std::span<const glm::dvec2> points, std::span<const double> relative_errors = {});

} // namespace tessera
