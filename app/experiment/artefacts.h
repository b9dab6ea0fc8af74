#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"

#include <cstddef>
#include <limits>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Errors of one image other than noise. Radiances are in units of the reference's mean luminance, so that dark
/// and bright scenes are judged equally; they keep their unit if the reference is black.
struct Artefacts {
    FloorFreeError error;       ///< relMSE in these units
    double mean = 0;            ///< mean luminance; the reference has 1, or 0 if it is black
    std::vector<double> worst;  ///< largest relative squared errors of pixels, descending (worst_count() of them)
    glm::ivec2 worst_pixel{0};  ///< pixel of the largest error
    std::size_t bad_pixels = 0; ///< pixels that are not finite in these units; they count as black elsewhere
    std::vector<double> pieces; ///< mean luminances of 8x8-pixel pieces, over those of the reference
    double tone_mapped = 0;     ///< mean squared error of the tone-mapped radiances x / (1 + x)
    double tenfold = 0;         ///< fraction of pixels off by more than a factor of ten in luminance
    /// Halo::energy and Halo::peak of the picture's buffers; NaN if no sample is a firefly.
    double halo_energy = std::numeric_limits<double>::quiet_NaN();
    double halo_peak = std::numeric_limits<double>::quiet_NaN();
};

/// Returns how many of the worst pixels are kept: more than one in a thousand, so that the worst pixels of
/// several runs together contain the 99.99th percentile of all.
std::size_t worst_count(std::size_t pixels);

/// Measures the artefacts of an image against two independent references. A pixel's squared error is
/// (I - r1)(I - r2) / (r^2 + relative_mse_epsilon), at least 0, so a firefly in one reference has little effect.
/// The tone-mapped error omits the denominator and the lower limit. A pixel is off by a factor of ten if it is so
/// against both references; luminances below 1 % of the mean count as 1 %. Throws std::invalid_argument if sizes
/// differ or the images are empty.
Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);

/// Noise of the two references in the units of Artefacts. The noise is assumed to be independent between pixels,
/// which holds for path tracing.
struct ReferenceNoise {
    bool is_black = false;
    double mean_error = 0; ///< standard error of the mean luminance of both references together
    double squared_error_error =
        0; ///< contribution of the references to the error of Artefacts::error, bias included
    std::vector<double> pieces[2]; ///< of each reference, as Artefacts::pieces
};

/// Estimates the noise from the difference of the references. Throws as measure_artefacts does.
ReferenceNoise measure_reference_noise(const RgbImage& reference1, const RgbImage& reference2);

/// How visible the tile grid is in an image's error. The spectral values are ratios of power: at the multiples of
/// the tile frequency 1 / tile (cycles per pixel, up to 1/2, along rows and columns), over the power at
/// neighbouring frequencies. Without a visible grid they are about 1.
struct TileSpectrum {
    /// Ratio for the error. It rises above 1 for a pattern that repeats in every tile. It falls below 1 for noise
    /// that is correlated within tiles but independent between them.
    double error = 0;
    /// Ratio for the squared differences between neighbouring pixels, averaged over columns and over rows. It
    /// rises above 1 for noise that is correlated within tiles on a fixed grid, which is visible as a grid.
    double edges = 0;
    /// Largest mean squared difference by position within the tile, over the mean at the other positions;
    /// infinite if that is 0. Mean of both directions.
    double edge_ratio = 0;
};

/// Measures the spectrum of the relative error (I - r) / sqrt(r^2 + relative_mse_epsilon) of luminances, clamped
/// to
/// [-1, 1] so that no pixel dominates. Throws std::invalid_argument if the sizes differ, `tile` is below 2, or an
/// edge is shorter than 4 tiles.
TileSpectrum measure_tile_spectrum(const RgbImage& image, const RgbImage& reference, int tile);

} // namespace tessera
