#pragma once

#include "recon/picture/reconstruct.h"

namespace tessera {

/// Does what Reconstructor::reconstruct does, once it has asked for the memory that it takes on so many threads.
/// Throws OutOfMemory with the figures where there is too little; the images, and what the reconstructor keeps,
/// are then as they were.
Reconstruction reconstruct_if_it_fits(Reconstructor& reconstructor, const GradientImages& images,
                                      const ReconstructionSettings& settings,
                                      const ParallelFor& parallel_for = serial_for, int threads = 1,
                                      const SolveWatch& watch = {});

} // namespace tessera
