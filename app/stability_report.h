#pragma once

#include "app/experiment.h"
#include "app/stability_scene.h"
#include "app/verdict.h"

#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// A scene of the suite and what is rendered of it.
struct StabilityCase {
    StabilityScene scene;
    std::unique_ptr<ExperimentOptions> options; ///< the experiment's
    std::unique_ptr<Experiment> experiment;

    const std::string& name() const { return experiment->scenes().front().name(); }
};

/// Writes stability.md and stability.csv on the scenes that have two runs and more of each point, to the folder of
/// the suite's options.
void write_stability(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases);

/// Writes SCENE.png: the reference, and the pictures of the first seed with the names of their points.
void write_sheet(const ExperimentOptions& suite, const StabilityCase& of);

} // namespace tessera
