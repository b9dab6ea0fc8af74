#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/reconstruct.h"

#include <optional>

namespace tessera {

/// What a spike does to a picture beyond the pixels that it was found in: a solver that trusts it tears a ring or
/// a blob around them.
struct Halo {
    glm::ivec2 spike{0}; ///< the pixel whose brightest sample moves its mean most
    double energy = 0;   ///< sum of the luminances by which the rest of the picture changes, over the spike's own
    double peak = 0;     ///< largest of them, over that pixel's own luminance and 1 % of the picture's mean
};

/// Reconstructs the images as they are, and with the mean of the others in the place of the brightest sample of
/// all pixels that may share the spike's: those of the square of edge 2 patch - 1 around it, or 2 patch + 1 with
/// gradients, whose sets reach a pixel further. What differs outside of that square is what the spike put there,
/// be it by the solver or as clamped energy that is redistributed (recon/guided/fireflies.h), which has an energy of
/// about 1, and a small peak. Empty: nothing is known of brightest samples, no sample is above the others, the
/// square has the whole picture, or that is black without the spike.
std::optional<Halo> measure_halo(const GradientImages& images, const ReconstructionSettings& settings,
                                 const ParallelFor& parallel_for);

/// The images with the mean of the others in the place of the brightest sample of each pixel of the square. At
/// least two samples.
GradientImages without_brightest(const GradientImages& images, PixelRect square);

} // namespace tessera
