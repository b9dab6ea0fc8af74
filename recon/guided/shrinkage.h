#pragma once

#include "recon/guided/planes.h"

namespace tessera {

/// Scratch planes of the image's size, any content.
struct ShrinkageScratch {
    Plane sizes, noise, rows;
};

/// Writes the trust c of reconstruction (52): how far the difference between a picture and a smoother one stands
/// out from its noise, in [0, 1],
///     max(0, 1 - (mean of |noise|^1/2 / mean of |difference|^1/2)^4),
/// after the shrinkage of [James and Stein 1961]. It goes to 1 as the noise goes to 0. Sizes are relative to the
/// brightness of the smoother picture. Means are over squares. They are means of roots, since in a mean of squares
/// a few pixels beside a lamp would decide for all around.
/// @param dark  `dark` L, which is added to a pixel's brightness, > 0
void write_trust(const NoisyPlanes& finer, const NoisyPlanes& coarser, const Plane& dark, int radius,
                 const ParallelFor& parallel_for, ShrinkageScratch& scratch, Plane& trust);

} // namespace tessera
