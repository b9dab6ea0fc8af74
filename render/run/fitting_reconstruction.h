#pragma once

#include "recon/picture/reconstruct.h"

namespace tessera {

/// Does what Reconstructor::reconstruct does, once it has asked for the memory that it takes on so many threads.
/// Throws OutOfMemory with the figures where there is too little; the images, and where the solvers stood, are
/// then as they were. What the reconstructor can do without it keeps only where there is room for it.
Reconstruction reconstruct_if_it_fits(Reconstructor& reconstructor, const GradientImages& images,
                                      const ReconstructionSettings& settings,
                                      const ParallelFor& parallel_for = serial_for, int threads = 1,
                                      const SolveWatch& watch = {});

} // namespace tessera
