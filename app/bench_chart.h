#pragma once

#include "app/curve.h"
#include "app/experiment.h"
#include "ui/chart.h"

namespace tessera {

/// Error against CPU seconds and against samples, a line for each curve, with the spread over the seeds as bars
/// (the uncertainty for one seed) and the slope in the key. Errors that are not certain are left out.
Chart bench_chart(const ExperimentOptions& options, const SceneCurves& scene);

/// Samples a CPU second against the triangles of the scenes, a line for each method, of its best curve. Worth
/// drawing for two scenes and more.
Chart triangle_chart(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

/// "gpr l2, tile 4".
std::string curve_label(const ExperimentOptions& options, const Curve& curve);

} // namespace tessera
