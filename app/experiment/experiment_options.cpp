#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "app/experiment/experiment.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

namespace {

void add_effort(CLI::App& command, ExperimentArguments& words) {
    CLI::Option* spp = add_setting(command, spp_setting(words.spp))->default_str("");
    limit_to_seconds(
        command.add_option("--time", words.time,
                           fmt::format("render time in seconds of each setup, instead of --spp (default {})",
                                       to_string(words.options.effort))))
        ->excludes(spp);
    add_clock(command, words.clock);
}

void add_references(CLI::App& command, ExperimentOptions& options) {
    options.references = "references";
    command.add_option("--reference", options.references, "folder of the references")->capture_default_str();
    Setting spp = spp_setting(options.recipe.spp, 2);
    spp.id = "reference_spp";
    add_setting(command, spp)->description("samples a pixel of references that are missing");
    Setting method = method_setting(options.recipe.settings.method);
    method.id = "reference_method";
    add_setting(command, method)->description("method of references that are missing");
}

void add_quick(CLI::App& command, ExperimentArguments& words) {
    command.add_flag(
        "--quick", words.is_quick,
        "a preview in minutes; unless given: 5 CPU seconds, 4 halvings, 2 seeds, 320x180 pixels, the weighted "
        "norm only, and references of 512 samples");
}

/// Applies the values of --quick to options that are not on the command line.
void take_quick(const CLI::App& command, ExperimentOptions& options) {
    const auto is_given = [&](const char* option) { return command.count(option) > 0; };
    if (!is_given("--time") && !is_given("--spp"))
        options.effort = {5, Effort::Unit::cpu_seconds};
    if (!is_given("--seeds"))
        options.seeds = 2;
    if (!is_given("--halvings"))
        options.halvings = 4;
    if (!is_given("--size"))
        options.settings.size = {320, 180};
    if (!is_given("--recon"))
        options.norms = {Norm::weighted};
    if (!is_given("--reference-spp"))
        options.recipe.spp = 512;
}

void add_sharing(CLI::App& command, ExperimentArguments& words) {
    WorkDivision& sharing = words.options.sharing;
    CLI::Option* list =
        command.add_flag("--list", words.lists, "print the jobs: number, state, estimated CPU seconds, contents");
    CLI::Option* job = command.add_option("--job", sharing.job, "run only the job of this number in the list");
    limit(job, 1, 1e9)->excludes(list);
    command.add_flag("--report", words.only_reports, "write the reports of the finished jobs; render nothing")
        ->excludes(list)
        ->excludes(job);
    command.add_option("--machine", sharing.machine,
                       "name of this kind of machine; results of different kinds are in separate rows "
                       "(default: processor and hardware threads)");
    command.add_flag("--any-machine", sharing.takes_any_machine, "merge the results of all kinds of machines");
    limit_to_seconds(
        command.add_option("--silence", sharing.silence,
                           "seconds without a heartbeat after which another process takes over a job"))
        ->capture_default_str();
}

void add_experiment(CLI::App& command, ExperimentArguments& words) {
    ExperimentOptions& options = words.options;
    forbid_empty(command.add_option("scenes", words.scenes, "Mitsuba scenes, XML"))->required()->take_all();
    add_picture_options(command, {options.settings.size, options.settings.render, options.settings.reconstruction,
                                  options.settings.threads});
    add_alpha(command, options.settings.reconstruction);
    command.get_option("--size")->default_str(size_setting(options.settings.size).text());
    command.get_option("--max-depth")->default_str(std::to_string(options.settings.render.max_depth));
    command.get_option("--seed")->description("seed of the first render of each setup");
    command
        .add_option("--vary", words.variations,
                    "SETTING=VALUE,VALUE,...: a setting and its values, such as tile=2,4,8, rr-delta=0.01,0.1,1, "
                    "alpha=0.1,0.2,0.4, max-depth=2,4,8, threads=1,2,4 or size=160x90,320x180; given twice: all "
                    "combinations")
        ->take_all()
        ->allow_extra_args(false);
    add_methods(command, words.methods, "or several: gpr,pr")->capture_default_str();
    add_effort(command, words);
    limit(command.add_option("--seeds", options.seeds, "renders of each setup, each with its own seed"), 1, 1000)
        ->capture_default_str();
    add_norms(command, words.norms, "or several, where there are gradients")->capture_default_str();
    add_references(command, options);
    command.add_flag("--any-build", options.takes_any_build, "also accept results of other builds of the program");
    command.add_option("-o,--output", options.output, "folder to write to")->required();
    add_sharing(command, words);
}

constexpr const char* common_footer =
    "A job is a scene and a seed, and with --spp one point of the variations. Within a job, methods take "
    "turns pass by pass. Several processes with the same command, on one machine or on machines that share "
    "the folder, divide the jobs (docs/cluster.md). Finished jobs are in OUTPUT/jobs; after an interruption, the "
    "same command continues from there. Another build (without --any-build), scene file, reference or "
    "setting starts new jobs.\n"
    "References are REFERENCE/SCENE-WxH-dDEPTH.exr, as `tessera reference` makes them. Missing ones are "
    "rendered first; references of another scene are refused. The reports name the method and "
    "reconstruction of each reference.";

} // namespace

void add_sweep(CLI::App& app, ExperimentArguments& words) {
    words.methods = "gpr";
    words.norms = "weighted";
    CLI::App& command = *app.add_subcommand(
        "sweep", "measure error, time and efficiency for values of settings, on scenes with references");
    command.footer(std::string("Writes sweep.csv, sweep.json, sweep.md and sweep-SCENE.svg to the output folder "
                               "and updates them as jobs finish.\n") +
                   common_footer);
    add_experiment(command, words);
}

void add_bench(CLI::App& app, ExperimentArguments& words) {
    words.methods = "pt,pr,gpt,gpr";
    words.norms = "l2,l1,mixed,weighted,guided";
    words.options.effort = {60, Effort::Unit::cpu_seconds};
    words.options.halvings = 6;
    words.options.seeds = 5;
    words.options.keeps_images = true;
    CLI::App& command =
        *app.add_subcommand("bench", "measure the error of methods over time, as one page with charts");
    command.footer(std::string("Writes bench.html, which needs no other file, bench.csv, bench.json and "
                               "bench-SCENE.svg to the output folder, and updates them as jobs finish. Writes the "
                               "pictures of the first seed to OUTPUT/images.\n") +
                   common_footer);
    add_experiment(command, words);
    add_quick(command, words);
    limit(command.add_option("--halvings", words.options.halvings,
                             "number of additional measurements, after 1/2, 1/4, ... of the time"),
          0, 20)
        ->capture_default_str();
}

void add_stability(CLI::App& app, ExperimentArguments& words) {
    ExperimentOptions& options = words.options;
    words.methods = "pt,pr,gpt,gpr";
    words.norms = "none,l2,l1,mixed,weighted,guided";
    options.settings.size = {96, 72};
    options.effort = {1, Effort::Unit::cpu_seconds};
    options.seeds = 20;
    options.output = "report";
    options.recipe.spp = 8192;
    CLI::App& command =
        *app.add_subcommand("stability", "judge all methods on small scenes, each known to make some method fail");
    command.footer(
        std::string("Writes stability.html, which needs no other file, stability.md, stability.csv and SCENE.png "
                    "to the output folder, and updates them as jobs finish. References are by PT, which reuses no "
                    "paths: a bias that a method shares with its reference would not show.\n") +
        common_footer);
    add_experiment(command, words);
    command.get_option("scenes")->required(false)->description(
        "Mitsuba scenes, XML (default: assets/stability), with <!-- fails: what and why --> and <!-- vary: NAME = "
        "VALUE, VALUE -->");
    command.get_option("--output")->required(false)->default_str("report");
    for (const char* other : {"--max-depth", "--vary", "--reference-method"})
        command.remove_option(command.get_option(other));
}

ExperimentOptions parse_experiment(const CLI::App& command, const ExperimentArguments& words) {
    ExperimentOptions options = words.options;
    options.command = command.get_name();
    options.scenes.assign(words.scenes.begin(), words.scenes.end());
    options.methods = parse_methods(words.methods);
    options.norms = parse_norms(words.norms);
    if (words.variations.size() > 2)
        throw BadInput("--vary: two settings at the most");
    for (const std::string& text : words.variations)
        options.variations.push_back(parse_variation(text));
    if (options.variations.size() == 2 && options.variations[0].variable.id == options.variations[1].variable.id)
        throw BadInput(fmt::format("--vary {}: the setting is varied twice", words.variations[1]));
    if (command.count("--spp"))
        options.effort = {static_cast<double>(words.spp), Effort::Unit::spp};
    if (command.count("--time"))
        options.effort = {words.time,
                          words.clock == "cpu" ? Effort::Unit::cpu_seconds : Effort::Unit::wall_seconds};
    if (words.is_quick)
        take_quick(command, options);
    using Task = WorkDivision::Task;
    options.sharing.task = words.lists                  ? Task::list
                           : words.only_reports         ? Task::report
                           : command.count("--job") > 0 ? Task::one_job
                                                        : Task::work;
    return options;
}

} // namespace tessera
