#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "app/experiment/experiment_jobs.h"
#include "app/report/reports.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

void write_bench(Experiment& experiment) {
    const ExperimentOptions& options = experiment.options();
    const std::vector<Result> results = experiment.results();
    const std::vector<SceneCurves> scenes = curves_by_scene(results);
    write_text(options.output / "bench.csv", to_csv(options, results));
    write_text(options.output / "bench.json", to_json(options, results));
    write_text(options.output / "bench-speedup.csv", speed_up_csv(options, scenes));
    for (const SceneCurves& scene : scenes) {
        const std::string name = file_name(scene.name);
        write_text(options.output / fmt::format("bench-{}.svg", name), to_svg(bench_chart(options, scene)));
        write_text(options.output / fmt::format("bench-{}-seen.svg", name), to_svg(seen_chart(options, scene)));
    }
    write_text(options.output / "bench.html", bench_page(experiment, scenes));
}

} // namespace

int run_bench(const ExperimentOptions& options) {
    Experiment experiment(options);
    const int code = run_jobs({&experiment}, options, [&] { write_bench(experiment); });
    if (options.sharing.task != WorkDivision::Task::list)
        fmt::print("{}\n", (options.output / "bench.html").string());
    return code;
}

int run_sweep(const ExperimentOptions& options) {
    Experiment experiment(options);
    const int code = run_jobs({&experiment}, options, [&] { write_sweep(experiment, experiment.results()); });
    if (options.sharing.task != WorkDivision::Task::list)
        fmt::print(stderr, "{}: sweep.csv, sweep.json, sweep.md and a chart of each scene\n",
                   options.output.string());
    return code;
}

namespace {

/// Derives the options of one scene from those of the suite.
ExperimentOptions options_for(const StabilityScene& scene, const ExperimentOptions& suite) {
    ExperimentOptions options = suite;
    options.scenes = {scene.source.file};
    options.variables = scene.source.variables;
    options.settings.render.max_depth = scene.depth;
    options.settings.size = options.recipe.size = scene.needs.size.value_or(suite.settings.size);
    options.seeds = scene.needs.seeds.value_or(suite.seeds);
    if (scene.needs.spp) {
        options.effort = {static_cast<double>(*scene.needs.spp), Effort::Unit::spp};
        // Each half has at least as many samples as a picture.
        options.recipe.spp = std::max(suite.recipe.spp, 2 * *scene.needs.spp);
    }
    options.measures_artefacts = true;
    options.keeps_images = true;
    options.output = suite.output / "scenes" / scene_name(scene.source);
    return options;
}

/// Throws BadInput for a reference that is not by PT. PT reuses no paths; a bias that a method shares with its
/// reference would not be visible.
void check_references(const MeasuredScene& scene) {
    for (const FolderReference* reference : scene.references()) {
        if (!reference->is_complete())
            continue;
        if (origin_of(reference->image()).method != Method::pt)
            throw BadInput(fmt::format("{} was not made by PT; the stability suite needs references by PT",
                                       reference->path().string()));
    }
}

std::vector<StabilityCase> cases_of(const ExperimentOptions& suite) {
    std::vector<StabilityCase> cases;
    const auto& files = suite.scenes.empty() ? built_in_stability_scenes() : suite.scenes;
    for (const StabilityScene& scene : stability_scenes(files)) {
        const auto is_same = [&](const StabilityCase& c) {
            return scene_name(c.scene.source) == scene_name(scene.source);
        };
        const auto same = std::find_if(cases.begin(), cases.end(), is_same);
        if (same != cases.end())
            throw BadInput(fmt::format("{} and {} are both named \"{}\"", to_string(same->scene.source),
                                       to_string(scene.source), scene_name(scene.source)));
        StabilityCase& c = cases.emplace_back();
        c.scene = scene;
        c.options = std::make_unique<ExperimentOptions>(options_for(scene, suite));
        c.experiment = std::make_unique<Experiment>(*c.options);
        check_references(std::as_const(*c.experiment).scenes().front());
    }
    return cases;
}

} // namespace

int run_stability(ExperimentOptions suite) {
    if (std::find(suite.methods.begin(), suite.methods.end(), Method::pt) == suite.methods.end())
        suite.methods.insert(suite.methods.begin(), Method::pt);
    suite.recipe.settings.method = Method::pt;
    suite.recipe.reconstruction.norm = Norm::none;
    make_folder(suite.output);
    check_writable(suite.output / "stability.md");
    const std::vector<StabilityCase> cases = cases_of(suite);
    std::vector<Experiment*> experiments;
    for (const StabilityCase& c : cases)
        experiments.push_back(c.experiment.get());
    const int code = run_jobs(experiments, suite, [&] {
        write_stability(suite, cases);
        for (const StabilityCase& c : cases)
            write_sheet(suite, c);
    });
    if (suite.sharing.task != WorkDivision::Task::list)
        fmt::print("{}\n", (suite.output / "stability.html").string());
    return code;
}

} // namespace tessera
