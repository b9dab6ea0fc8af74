#pragma once

#include "app/experiment.h"

#include <string>

namespace tessera {

/// A line for each result: scene, method, reconstruction, what is varied, the share of time or samples, and all
/// figures; an empty cell where there is none.
std::string to_csv(const ExperimentOptions& options, const std::vector<Result>& results);

/// The same, with the machine, all settings and every single run.
std::string to_json(const ExperimentOptions& options, const std::vector<Result>& results);

/// What a result's time or number of samples was to be.
Effort effort_of(const ExperimentOptions& options, const Result& result);

/// "gpr", "gpr l1, roulette absolute": the line of a chart that a result is on, which says what tells it from
/// others with the same value of the first variation.
std::string line_label(const ExperimentOptions& options, const Result& result);

} // namespace tessera
