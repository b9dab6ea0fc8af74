#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

#include <cstddef>
#include <cstdint>

namespace tessera {

// Where light goes that is known to be about, and not where: what spikes hold back (recon/picture/spikes.h), and
// what a solver has put above the bounds (recon/picture/bounds.h). With K, a symmetric kernel, and S, the
// brightness that light follows, H becomes
//     S K(H / K(S)) ,
// which has the sum of H: what a pixel q has goes to p as S(p) K(p, q) / (sum over the p' of S(p') K(p', q)).

/// The sum of |light| over all pixels; 0: there is nothing to spread.
double sum_of_sizes(const RgbImage& light, const ParallelFor& parallel_for);

/// Spreads over the pixels that look alike, by their brightness and albedo: a spike on a wall is found all over
/// the wall. Keeps the light's sum, but for rounding.
/// @param light   radiance to spread; becomes what is left over, and where: what pixels would have had beyond
///                `room`, or more than a tenth of their brightness, as where few others look alike
/// @param image   radiance without very direct light, gets the rest
/// @param guides  for albedos; empty: all are 1
/// @param room    how much more light each pixel may have, 0 or less: none; empty: any
void spread_to_alike(RgbImage& light, RgbImage& image, const AlikePixels& alike, const GuideImages& guides,
                     const RgbImage& room, const ParallelFor& parallel_for);

/// What light follows that goes to the pixels around: the brightness about each, and what of it is around there.
struct LitSurroundings {
    Plane brightness, around;
};
/// @param shown  the radiance whose brightness it is
/// @param black  1 where a pixel is to be given none; empty: nowhere
LitSurroundings lit_surroundings(const RgbImage& shown, const AlikePixels& alike, const Image<std::uint8_t>& black,
                                 const ParallelFor& parallel_for);

/// Adds to the image as much light as there is in `light`, given to the pixels around where it is, whatever they
/// look like, about 20 pixels wide, by the brightness about each: but for rounding, and for what is about black
/// pixels alone, which is lost.
void spread_around(const RgbImage& light, const LitSurroundings& surroundings, RgbImage& image,
                   const ParallelFor& parallel_for);

/// The memory that all of this takes, a pixel: kernels; S, its limits, what is spread and a quotient; or when
/// these are gone LitSurroundings and the two images that spread_around() has, which is less.
inline constexpr std::size_t bytes_to_spread_a_pixel = AlikePixels::bytes_a_pixel + 12 * sizeof(float);

} // namespace tessera
