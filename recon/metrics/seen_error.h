// How different pictures look on a screen: as sRGB at exposure 0, where what is brighter than white is white.
#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

namespace tessera {

/// The peak signal-to-noise ratio, in decibels, of a picture to a noiseless one that two independent references
/// surround: -10 log10 of the mean of (D(I) - D(r1)) (D(I) - D(r2)), where D is what the screen shows, in [0, 1].
/// Not a number where that mean is not above 0, as of equal pictures. Throws std::invalid_argument if sizes differ
/// or the images are empty.
double psnr(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);

/// FLIP [Andersson 2020]: how much an observer who flips between two pictures sees them differ, at each pixel, in
/// [0, 1], from 0.7 m before a 4K screen 0.7 m wide. By what of their colours the eye resolves at that distance,
/// and what differs in edges and points. A noisy reference counts as if it were none.
Image<float> flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for = serial_for);

/// The mean of that map.
double mean_flip(const RgbImage& image, const RgbImage& reference, const ParallelFor& parallel_for = serial_for);

} // namespace tessera
