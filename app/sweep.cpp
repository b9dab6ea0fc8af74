#include "app/sweep.h"

#include "app/exit_codes.h"
#include "app/sweep_report.h"

#include <fmt/core.h>

namespace tessera {

int run_sweep(const ExperimentOptions& options) {
    Experiment experiment(options);
    experiment.run([&] { write_sweep(options, experiment.results()); });
    fmt::print(stderr, "{}: sweep.csv, sweep.json, sweep.md and a chart of each scene\n", options.output.string());
    return exit_ok;
}

} // namespace tessera
