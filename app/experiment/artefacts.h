#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"

#include <cstddef>
#include <limits>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// What can be wrong with one image, beside being noisy. All radiances are in units of the reference's mean
/// luminance (in their own, if the reference is black), so that dark scenes are judged as bright ones are.
struct Artefacts {
    FloorFreeError error;       ///< relMSE
    double mean = 0;            ///< luminance; 1 is the reference's, but for a black one's 0
    std::vector<double> worst;  ///< largest relative squared errors of pixels, from the worst on (worst_count)
    glm::ivec2 worst_pixel{0};  ///< where the first of them is
    std::size_t bad_pixels = 0; ///< not finite in these units: they count as black in all that is above
    std::vector<double> pieces; ///< pieces_of the image, by those pixels
    double tone_mapped = 0;     ///< mean squared error of tone-mapped radiances, x / (1 + x): of what is seen
    double tenfold = 0; ///< share of pixels of more than ten times the reference's luminance, or below a tenth
    /// Halo::energy and Halo::peak of what the picture is made of; not numbers where no sample is a spike.
    double halo_energy = std::numeric_limits<double>::quiet_NaN();
    double halo_peak = std::numeric_limits<double>::quiet_NaN();
};

/// How many of the worst pixels are kept: more than one in a thousand, so that several runs' together tell the
/// 99.99th percentile of all.
std::size_t worst_count(std::size_t pixels);

/// A pixel's squared error is (I - r1)(I - r2) / (r^2 + relative_mse_epsilon), at least 0, so that a spike of one
/// reference is not taken for one of the image. Its tone-mapped one is that, without denominator; and it is off by
/// tenfold if both references say so, of which one hundredth of the mean is taken where they are darker. Throws
/// std::invalid_argument if the sizes differ or the images are empty.
Artefacts measure_artefacts(const RgbImage& image, const RgbImage& reference1, const RgbImage& reference2);

/// What is known of the two references that images are measured by, in the units of Artefacts. Their noise is
/// taken to be independent from pixel to pixel, as that of naive path tracing is.
struct ReferenceNoise {
    bool is_black = false;
    double mean_error = 0;          ///< standard error of the mean luminance of both references together
    double squared_error_error = 0; ///< that the references give to Artefacts::error, its small bias included
    std::vector<double> pieces[2];  ///< of each reference, as Artefacts::pieces
};

/// Finds it from how the two differ. Throws as measure_artefacts does.
ReferenceNoise measure_reference_noise(const RgbImage& reference1, const RgbImage& reference2);

/// How much of an image's error repeats with the tiles by which its pixels shared light. All are ratios of
/// spectral power: that at the multiples of the tile frequency 1 / tile (cycles a pixel, up to 1/2, along rows and
/// along columns), over that at the frequencies about them. 1: the grid of tiles does not show.
struct TileSpectrum {
    /// The ratio for the error itself. A pattern that is alike in every tile stands out; noise that is alike
    /// within tiles, but not between them, has nothing there: it is below 1.
    double error = 0;
    /// The ratio for the error's squared steps from pixel to pixel, as means over whole columns and rows. They are
    /// larger where tiles meet, if noise is alike within tiles and the grid is never moved: that is what the eye
    /// sees as a grid.
    double edges = 0;
    /// Mean squared step across the columns and rows of the grid where it is largest, over that across the others;
    /// infinite where there are no others.
    double edge_ratio = 0;
};

/// The spectrum of the relative error (I - r) / sqrt(r^2 + relative_mse_epsilon), as luminances, cut to [-1, 1] so
/// that a few pixels do not decide. The images must be of one size, of 4 tiles of 2 or more pixels at the least
/// along each edge; throws std::invalid_argument.
TileSpectrum measure_tile_spectrum(const RgbImage& image, const RgbImage& reference, int tile);

} // namespace tessera
