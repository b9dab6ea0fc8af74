#pragma once

#include "app/experiment.h"

namespace tessera {

/// `tessera sweep`: renders every scene with every point of the experiment, compares with references, and writes
/// sweep.csv, .json, .md and a chart a scene, anew after each round. Returns an ExitCode. Throws BadInput or
/// another std::exception before anything was rendered, but for scene files that cannot be loaded: these are met
/// in turn.
int run_sweep(const ExperimentOptions& options);

} // namespace tessera
