#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstdint>

namespace tessera {

/// Makes the picture of the radiance v from that of the coefficient e = v / a, which is `image` (without very
/// direct light) and becomes the answer. With m as the mean over the samples, A as the albedo's over the pixel and
/// E as the coefficient that is reconstructed,
///     V = A E + k rho .
/// rho estimates the covariance of a and e over the points of a pixel: where both change within it, as at edges of
/// objects, the mean of their product is not the product of their means.
///
/// Unbiased, as E is a linear function of the samples: A is the mean over points that have nothing to do with
/// these, k = 1, rho = m(v) - A m(e). The samples' own albedos count in full, with their noise.
///
/// Else consistent: A is the mean over all points that are known, and
///     rho = m(v) - A m(e) - b (m(a) - A) ,
/// where b says how v changes with a within the pixel, by regression over the samples of 3x3 pixels, with E as a
/// prior: a control variate that takes away the noise of how the few samples happened to fall on a texture, where
/// v follows a with b = E, or on two surfaces. k in [0, 1] goes to 1 where rho stands out from the noise that
/// light alone makes of it, in the 3x3 pixels around [after James and Stein 1961],
///     k = max(0, 1 - mean(sqrt(noise))^2 / mean(rho^2)) .
/// Without variances, k = 0.
void remodulate(const GradientImages& images, bool is_unbiased, RgbImage& image, const ParallelFor& parallel_for);

/// A of pixel (x, y) where the answer is not unbiased: the mean of all albedos that are known of it.
Rgb known_albedo(const Demodulation& demodulation, int x, int y);

/// Multiplies an image by that, coefficients to radiance; without a demodulation it is radiance already.
void multiply_by_known_albedo(const Demodulation& demodulation, RgbImage& image, const ParallelFor& parallel_for);

/// The memory that remodulate() takes.
std::uint64_t bytes_to_remodulate(int width, int height);

/// The sample covariance of albedo and coefficient, m(v) - m(a) m(e): what there is to see of the above.
RgbImage sample_covariance(const GradientImages& images);

} // namespace tessera
