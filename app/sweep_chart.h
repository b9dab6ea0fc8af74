#pragma once

#include "app/chart.h"
#include "app/sweep.h"
#include "app/sweep_result.h"

#include <vector>

namespace tessera {

/// Error and efficiency of one scene's results against the first variation (or the method, if nothing is varied):
/// a line for every method and value of the second.
Chart sweep_chart(const SweepOptions& options, const std::vector<SweepResult>& results);

/// "gpr, roulette absolute": the line that a result is on.
std::string line_label(const SweepOptions& options, const SweepResult& result);

} // namespace tessera
