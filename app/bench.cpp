#include "app/bench.h"

#include "app/bench_chart.h"
#include "app/bench_page.h"
#include "app/exit_codes.h"
#include "app/output_file.h"
#include "app/result_files.h"
#include "app/speed_up_table.h"

#include <fmt/core.h>

namespace tessera {

namespace {

void write_bench(const Experiment& experiment) {
    const ExperimentOptions& options = experiment.options();
    const std::vector<Result> results = experiment.results();
    const std::vector<SceneCurves> scenes = curves_by_scene(results);
    write_text(options.output / "bench.csv", to_csv(options, results));
    write_text(options.output / "bench.json", to_json(options, results));
    write_text(options.output / "bench-speedup.csv", speed_up_csv(options, scenes));
    for (const SceneCurves& scene : scenes)
        write_text(options.output / fmt::format("bench-{}.svg", scene.name), to_svg(bench_chart(options, scene)));
    write_text(options.output / "bench.html", bench_page(experiment, scenes));
}

} // namespace

int run_bench(const ExperimentOptions& options) {
    Experiment experiment(options);
    experiment.run([&] { write_bench(experiment); });
    fmt::print("{}\n", (options.output / "bench.html").string());
    return exit_ok;
}

} // namespace tessera
