#pragma once

#include "app/sweep.h"
#include "app/sweep_result.h"

#include <string>
#include <vector>

namespace tessera {

/// Writes sweep.csv, sweep.json, sweep.md, and the chart of the last scene, sweep-SCENE.svg, to the sweep's
/// folder. Results without a run are left out.
void write_sweep(const SweepOptions& options, const std::vector<SweepResult>& results, int threads,
                 bool is_interrupted);

} // namespace tessera
