#pragma once

#include "app/curve.h"
#include "app/experiment.h"

#include <string>

namespace tessera {

/// One HTML page that needs no other file: speed-up at equal error, then for every scene its chart, its figures
/// and crops of the pictures at equal time, and at the end settings and machine. Pictures and references that
/// cannot be read are left out.
std::string bench_page(const Experiment& experiment, const std::vector<SceneCurves>& scenes);

} // namespace tessera
