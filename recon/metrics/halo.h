#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/picture/reconstruct.h"

#include <optional>

namespace tessera {

/// Effect of the strongest firefly on the picture outside the pixels that found it, such as a ring or a blob that
/// a solver makes around them.
struct Halo {
    glm::ivec2 firefly{0}; ///< pixel whose brightest sample moves its mean most
    double energy = 0; ///< sum of luminance changes in the rest of the picture, over the luminance of the firefly
    double peak = 0;   ///< largest change, over the sum of that pixel's luminance and 1 % of the picture's mean
};

/// Reconstructs the images twice: as they are, and without the brightest sample of all pixels that may have the
/// firefly's light. These are the square of edge 2 patch - 1 around it, or 2 patch + 1 with gradients, whose sets
/// reach a pixel further. Differences outside the square are the halo. Clamped energy that is redistributed
/// (recon/guided/fireflies.h) has an energy of about 1 and a small peak. Returns empty if brightest samples are
/// unknown, if no sample is brighter than the others, if the square covers the whole picture, or if the picture is
/// black without the firefly.
std::optional<Halo> measure_halo(const GradientImages& images, const ReconstructionSettings& settings,
                                 const ParallelFor& parallel_for);

/// Returns the images with the brightest sample of each pixel of the square replaced by the mean of its other
/// samples. Needs at least two samples.
GradientImages without_brightest(const GradientImages& images, PixelRect square);

} // namespace tessera
