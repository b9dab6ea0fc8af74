#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera {

// What a solver leaves is smoothed where pixels look alike, as far as it is noise. The measure of noise is the
// half difference of two halves of the samples (HalfDifferences), which has gone through the same solver as the
// picture and goes through the same smoothing: so that it tells what is left of the noise at every size, however
// alike that is in the pixels of a tile.
//
// Level l + 1 of a picture is level l, smoothed by a kernel of 9 pixels, those of 5x5 in the row and the column of
// the middle one, 3^l apart [the a trous filter of Dammertz 2010; there all of them, 2^l apart]. A pixel counts
// the less the less it looks like the one in the middle: in its guides, and in its brightness beside the noise
// that both have at that level [as in Schied 2017], where the squares around them tell as much as the two
// (write_noisy_weights). The picture is the last level plus the differences between each level and the next, each
// as far as it stands out from its noise in the pixels around [James and Stein 1961],
//     c = max(0, 1 - (mean of |noise|^1/2 / mean of |difference|^1/2)^4) .
// Last comes a regression on guides, which takes the noise of edges (guide_regression.h), as far as the difference
// to it does not stand out likewise. Noise goes to zero as samples grow, and c to 1: the picture is consistent. It
// is not linear in the samples.

/// A picture, and noise like its own.
struct NoisyPicture {
    RgbImage image, noise;
};

/// What smoothing finds about a picture and its noise, so that a picture of about the same samples can be smoothed
/// likewise: that asks for no noise. Empty: nothing has been found.
struct SmoothingFit {
    static constexpr std::size_t levels = 4; ///< of AlikePixels: pixels within 80

    std::array<StraightWeights, levels> weights; ///< how much pixels count for each other
    std::array<Plane, levels + 1> trust;         ///< c of each level, and of the regression, if there was one

    static constexpr std::size_t bytes_a_pixel =
        levels * straight_pairs * sizeof(PairWeight) + (levels + 1) * sizeof(float);
    bool empty() const { return trust[0].empty(); }
};

/// Smooths radiance without very direct light, over the albedo of its guides: what a texture does to light is
/// known. Light is not quite kept. With the noise that is left: what of the noise has gone the same way. Empty:
/// stopped. The same bits for any parallel_for.
/// @param alike  by these guides
/// @param fit    null: not asked for. Becomes empty where pictures stay what they are, as good as black or not
///               finite; anything: stopped
NoisyPicture smooth_by_guides(NoisyPicture picture, const GuideImages& guides, const AlikePixels& alike,
                              const ParallelFor& parallel_for, const SolveWatch& watch = {},
                              SmoothingFit* fit = nullptr);

/// Does with a picture what has been done with that of `fit`, not empty; one that is not finite stays what it is.
/// Empty: stopped.
/// @param guides, alike  about those of the fit
RgbImage smooth_likewise(RgbImage picture, const GuideImages& guides, const AlikePixels& alike,
                         const SmoothingFit& fit, const ParallelFor& parallel_for, const SolveWatch& watch = {});

/// The memory that smoothing takes, beside what it is given and a fit.
std::uint64_t bytes_to_smooth(int width, int height);

} // namespace tessera
