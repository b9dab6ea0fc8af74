#pragma once

#include "recon/image.h"

namespace tessera {

/// How much of an image's error repeats with the tiles by which its pixels shared light. All are ratios of
/// spectral power: that at the multiples of the tile frequency 1 / tile (cycles a pixel, up to 1/2, along rows and
/// along columns), over that at the frequencies about them. 1: the grid of tiles does not show.
struct TileSpectrum {
    /// Of the error itself. A pattern that is alike in every tile stands out; noise that is alike within tiles,
    /// but not between them, has nothing there: it is below 1.
    double error = 0;
    /// Of its squared steps from pixel to pixel, as means over whole columns and rows. They are larger where tiles
    /// meet, if noise is alike within tiles and the grid is never moved: that is what the eye sees as a grid.
    double edges = 0;
    /// Mean squared step across the columns and rows of the grid where it is largest, over that across the others;
    /// infinite where there are no others.
    double edge_ratio = 0;
};

/// Of the relative error (I - r) / sqrt(r^2 + relative_mse_epsilon), as luminances, cut to [-1, 1] so that a few
/// pixels do not decide. The images must be of one size, of 4 tiles of 2 or more pixels at the least along each
/// edge; throws std::invalid_argument.
TileSpectrum measure_tile_spectrum(const RgbImage& image, const RgbImage& reference, int tile);

} // namespace tessera
