#pragma once

#include "app/experiment.h"

namespace tessera {

/// Writes sweep.csv, sweep.json, sweep.md, and a chart of each scene, sweep-SCENE.svg, to the sweep's folder.
void write_sweep(const ExperimentOptions& options, const std::vector<Result>& results);

} // namespace tessera
