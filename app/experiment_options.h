#pragma once

#include "app/experiment.h"

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace tessera {

/// The words of `tessera sweep`, `bench` and `stability`, before they are given a meaning.
struct ExperimentWords {
    std::vector<std::string> scenes, variations;
    std::string size, methods, norms, clock = "cpu";
    int spp = 0;
    double time = 0;
    ExperimentOptions options; ///< all that is not above
};

// They add the commands; `words` take what is given to them, and must live as long as `app`.
void add_sweep(CLI::App& app, ExperimentWords& words);
void add_bench(CLI::App& app, ExperimentWords& words);
void add_stability(CLI::App& app, ExperimentWords& words);

/// What the words mean that were given to one of these commands. Throws BadInput that names the option.
ExperimentOptions parse_experiment(const CLI::App& command, const ExperimentWords& words);

} // namespace tessera
