#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstdint>

namespace tessera {

// Remodulation: the picture of the radiance v from that of the coefficient e = v / a, where a is the albedo. With
// m as the mean over the samples, A as the mean albedo of the pixel and E as the reconstructed coefficient,
//     V = A E + rho .
// rho estimates the covariance of a and e within a pixel: where both change, as at edges of objects, the mean of
// their product is not the product of their means.

/// Makes the picture of E that of V, without bias where E is a linear function of the samples: A is the mean over
/// points that are independent of the samples, rho = m(v) - A m(e), and V keeps the noise of the samples' albedos.
void recombine(const GradientImages& images, RgbImage& image, const ParallelFor& parallel_for);

/// Makes the picture of E that of V, with less noise; consistent. A is the mean over all points that are known,
/// and
///     rho = k (m(v) - A m(e) - b (m(a) - A)) .
/// b is the slope of v over a within the pixel, by regression over the samples of 3x3 pixels, with E as a prior: a
/// control variate that removes the noise of where the samples fell on a texture or on two surfaces. k in [0, 1]
/// goes to 1 where rho exceeds the noise that light alone makes of it, in the 3x3 pixels around [after James and
/// Stein 1961],
///     k = max(0, 1 - mean(sqrt(noise))^2 / mean(rho^2)) .
/// Without variances, or with the stage `covariance` off, k = 0.
void remodulate(const GradientImages& images, const GuidedParameters& parameters, RgbImage& image,
                const ParallelFor& parallel_for);

/// A of pixel (x, y) in remodulate(): the mean of all albedos that are known of it.
Rgb known_albedo(const Demodulation& demodulation, int x, int y);

/// Multiplies an image of coefficients by known_albedo(); without a demodulation it is radiance already.
void multiply_by_known_albedo(const Demodulation& demodulation, RgbImage& image, const ParallelFor& parallel_for);

/// The memory that remodulate() takes.
std::uint64_t bytes_to_remodulate(int width, int height);

/// The sample covariance of albedo and coefficient, m(v) - m(a) m(e).
RgbImage sample_covariance(const GradientImages& images);

} // namespace tessera
