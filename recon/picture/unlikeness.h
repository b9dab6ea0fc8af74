#pragma once

#include "recon/parallel.h"
#include "recon/picture/guide_kernel.h"

namespace tessera {

/// How unlike the pixels of each pair are by their brightness, where that is noisy: half by the two alone, half by
/// all pairs in the same direction from a square about as wide as the kernel, as patches tell in non-local means
/// [Buades 2005]. Of noise a few pixels have much, and look unlike by it alone; and what noise hides between two
/// pixels, it does not hide in a square.
/// @param brightness  its logarithm
/// @param noise       the variance of its noise
/// @param step        between the pixels of a pair
/// @param scratch     of the picture's size, anything
/// @param unlike      likewise; becomes what write_pair_weights() takes
void write_unlikeness(const Plane& brightness, const Plane& noise, int step, const ParallelFor& parallel_for,
                      Plane& scratch, PairWeights& unlike);

} // namespace tessera
