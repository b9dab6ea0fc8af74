// How far images are from a reference, or from two whose noises do not correlate.
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

/// How far an image I is from a reference r. Means are over pixels and their three channels.
struct ErrorMetrics {
    double relative_mse = 0;         ///< mean of (I - r)^2 / (r^2 + relative_mse_epsilon)
    double relative_mse_trimmed = 0; ///< the same without the worst 0.01 % of the pixels (rounded down)
    double mse = 0;                  ///< mean of (I - r)^2
    double mape = 0;                 ///< mean of |I - r| / (|r| + mape_epsilon); 1 is 100 %
    double mean_ratio = 0;           ///< mean of I over mean of r
    std::size_t bad_pixels = 0; ///< pixels of I that are not finite; if there are any, the errors are not either
};

/// Measures them all. Throws std::invalid_argument if the sizes differ or the images are empty.
ErrorMetrics measure_error(const RgbImage& image, const RgbImage& reference);

/// The sum of the values of a square piece of an image, and how many pixels that has.
struct Piece {
    double sum = 0;
    double pixels = 0;
};

/// The pieces of an image, row by row: squares with an edge of `edge` pixels, and what is left at the right and at
/// the bottom.
std::vector<Piece> pieces_of(const Image<double>& values, int edge);

/// An estimate of relative_mse to a noiseless reference, from two noisy ones.
struct FloorFreeError {
    double relative_mse = 0; ///< mean of (I - r1)(I - r2) / (r^2 + epsilon), r = (r1 + r2) / 2
    /// The standard error of relative_mse, from how pieces of 16 by 16 pixels differ (pixels, if pieces are few).
    double standard_error = 0;
};

/// Estimates it. The noises of two independent references do not correlate, so that their products vanish in the
/// mean, and an image equal to the truth gets 0 give or take the standard error. What is left, as r^2 is noisy
/// too, is of the order of the fourth power of the references' relative noise: 1.5e-4 for 10 %. Throws as
/// measure_error does.
FloorFreeError measure_floor_free_error(const RgbImage& image, const RgbImage& reference1,
                                        const RgbImage& reference2);

/// By how much an image is too bright (positive) or too dark in each quarter of the pixels, from the darkest to
/// the brightest: mean luminance of I over that of r, minus 1. Two independent references take turns to sort the
/// pixels and to judge them, as what looks dark in the judge is dark by chance, too. Not finite for
/// a quarter that is black in a reference, or empty. Throws as measure_error does.
std::array<double, 4> measure_energy_change(const RgbImage& image, const RgbImage& reference1,
                                            const RgbImage& reference2);

/// How far the mean r of two independent references is from the truth, by their difference:
///   mean of ((r1 - r2) / 2)^2 / (r^2 + epsilon).
/// What both err alike, as a biased reconstruction does, is not in it. Throws as measure_error does.
FloorFreeError measure_reference_error(const RgbImage& reference1, const RgbImage& reference2);

// The maps of which these are means have a value a pixel, the mean of its channels.
Image<double> floor_free_errors(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);
Image<double> reference_errors(const RgbImage& reference1, const RgbImage& reference2);
/// The mean of such a map, and its standard error.
FloorFreeError mean_of_pieces(const Image<double>& errors);

/// The slope of a line in a log-log chart, and the most that its standard error can be: points of one render stand
/// on the same samples, so that their errors may go together in any way.
struct Slope {
    double value, error;
};

/// The exponent b of y ~ x^b, the slope of a line in a log-log chart, by least squares of the logarithms: -1 for
/// an error that falls as noise does. Left out are points that have no place there. Not a number for fewer than
/// two places along x.
/// @param relative_errors  the standard error of each y, over that y; none: the slope's is not a number
Slope log_log_slope(std::span<const glm::dvec2> points, std::span<const double> relative_errors = {});

} // namespace tessera
