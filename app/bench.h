#pragma once

#include "app/experiment.h"

namespace tessera {

/// `tessera bench`: renders every scene with every method and reconstruction in turn, takes errors at doubling
/// times, and writes bench.html (which needs no other file), bench.csv, bench-speedup.csv, bench.json and a chart
/// a scene, anew after each round. Returns an ExitCode. Throws as run_sweep does.
int run_bench(const ExperimentOptions& options);

} // namespace tessera
