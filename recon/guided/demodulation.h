#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/parameters.h"

#include <cstdint>

namespace tessera {

// Remodulation: makes the radiance v from the coefficient e = v / a, where a is the albedo. With m as the mean
// over the samples, A as the mean albedo of the pixel and E as the reconstructed coefficient,
//     V = A E + rho .
// rho estimates the covariance of a and e within a pixel, theory (28). Where both change, as at edges of objects,
// the mean of their product is not the product of their means.

/// Replaces E by V, theory (29). V is unbiased if E is a linear function of the samples: A is the mean over
/// points that are independent of the samples, and rho = m(v) - A m(e). V keeps the noise of the samples' albedos.
void recombine(const GradientImages& images, RgbImage& image, const ParallelFor& parallel_for);

/// Replaces E by V with less noise, reconstruction (45) to (47); consistent. A is known_albedo(), and
///     rho = k (m(v) - A m(e) - b (m(a) - A)) .
/// b is the slope of v over a within the pixel, by regression over the samples of 3x3 pixels, with E as prior. As
/// a control variate, it removes the noise of where the samples fell on a texture or on two surfaces. k in [0, 1]
/// goes to 1 where rho exceeds the noise of the light in the 3x3 pixels around [after James and Stein 1961],
///     k = max(0, 1 - mean(sqrt(noise))^2 / mean(rho^2)) .
/// Without variances, or with the stage `covariance` off, k = 0.
void remodulate(const GradientImages& images, const GuidedParameters& parameters, RgbImage& image,
                const ParallelFor& parallel_for);

/// Returns A of pixel (x, y) in remodulate(): the mean of all known albedos, of samples and of other points.
Rgb known_albedo(const Demodulation& demodulation, int x, int y);

/// Multiplies coefficients by known_albedo(). Without a demodulation the image is radiance already and stays.
void multiply_by_known_albedo(const Demodulation& demodulation, RgbImage& image, const ParallelFor& parallel_for);

/// Returns the bytes that remodulate() allocates.
std::uint64_t bytes_to_remodulate(int width, int height);

/// Returns the sample covariance of albedo and coefficient, m(v) - m(a) m(e).
RgbImage sample_covariance(const GradientImages& images);

} // namespace tessera
