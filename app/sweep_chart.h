#pragma once

#include "app/experiment.h"
#include "ui/chart.h"

namespace tessera {

/// Error, efficiency and speed of one scene's results against the first variation (or the method, if nothing is
/// varied): a line for every method and value of the second.
Chart sweep_chart(const ExperimentOptions& options, const std::vector<Result>& results);

} // namespace tessera
