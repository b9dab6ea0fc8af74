#pragma once

#include "recon/picture/reconstruct.h"

namespace tessera {

/// Calls Reconstructor::reconstruct() if there is enough memory for it on so many threads. Otherwise throws
/// OutOfMemory with the figures, and leaves images and reconstructor unchanged. Lets the reconstructor keep its
/// optional data only if there is memory to spare.
Reconstruction reconstruct_checked(Reconstructor& reconstructor, const GradientImages& images,
                                   const ReconstructionSettings& settings,
                                   const ParallelFor& parallel_for = serial_for, int threads = 1,
                                   const SolveWatch& watch = {});

} // namespace tessera
