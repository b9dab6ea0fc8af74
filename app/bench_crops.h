#pragma once

#include "app/curve.h"
#include "app/experiment.h"

#include <string>

namespace tessera {

/// HTML: the reference of a scene with the crops marked, and these crops of the reference and of every picture of
/// the first seed. Empty where there is no picture, or none of the reference's size.
std::string crops_section(const Experiment& experiment, const SceneCurves& scene);

} // namespace tessera
