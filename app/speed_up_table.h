#pragma once

#include "app/curve.h"
#include "app/experiment.h"
#include "app/speed_up.h"

namespace tessera {

/// A line for each pair of curves of a scene of which the first is not of G-PR and the second is.
std::string speed_up_csv(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

} // namespace tessera
