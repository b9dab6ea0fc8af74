// Visible differences between pictures on a screen: sRGB at exposure 0, clipped at white.
#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

namespace tessera {

/// Returns the peak signal-to-noise ratio in decibels, estimated from two independent references:
/// -10 log10 of the mean of (D(I) - D(r1)) (D(I) - D(r2)), where D is the sRGB code in [0, 1]. The noise of the
/// references drops out of the mean. Returns infinity if the mean is 0, as for equal pictures, and NaN if it is
/// below 0, as noise makes it for a picture very close to the truth. Throws std::invalid_argument if sizes differ
/// or the images are empty.
double psnr(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);

/// Returns the FLIP map [Andersson 2020]: the difference at each pixel, in [0, 1], that an observer sees who flips
/// between two pictures, 0.7 m from a 4K screen 0.7 m wide. It combines differences of colours at the eye's
/// resolution with those of edges and points. Noise of the reference counts as difference. Throws as psnr() does.
Image<float> flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for = serial_for);

/// Returns the mean of flip().
double mean_flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for = serial_for);

} // namespace tessera
