#include "app/options.h"

#include "app/compare.h"
#include "app/contact_sheet.h"
#include "app/exit_codes.h"
#include "app/info.h"
#include "app/load_notes.h"
#include "app/option_values.h"
#include "app/reconstruct_options.h"
#include "app/render.h"
#include "app/setting_options.h"
#include "app/sweep.h"
#include "app/view.h"
#include "render/session/thread_pool.h"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

namespace {

/// The words of the command line, before they are given a meaning.
struct Words {
    std::string scene, camera, size, window, method = "gpr", norms, clock = "wall";
    std::vector<std::string> definitions;
    int spp = 0;
    double time = 0;
    double seconds = 5;
    std::vector<std::string> scenes, variations;
    float alpha = 0.2f;
    int threads = 0;
    RenderSettings settings;

    SceneSource source() const { return {scene, parse_variables(definitions), camera}; }
};

void add_scene(CLI::App& command, Words& words, bool required) {
    command.add_option("scene", words.scene, "Mitsuba scene, XML")->required(required);
    command.add_option("-D", words.definitions, "name=value: replaces the <default> of that name")->take_all();
    command.add_option("--camera", words.camera, "JSON file with the camera to take, as saved in the viewer");
}

void add_settings(CLI::App& command, Words& words) {
    RenderSettings& s = words.settings;
    command.add_option("--size", words.size, "WIDTHxHEIGHT of the image, pixels (default: the scene's)");
    add_setting_options(command, s);
    command.add_option("--alpha", words.alpha, "weight of the primal against the gradients")
        ->check(CLI::Range(1e-4, 1e3))
        ->capture_default_str();
    command.add_option("--seed", s.seed, "of the random numbers")->capture_default_str();
    command.add_option("--threads", words.threads, "0: one a hardware thread")->check(CLI::Range(0, 1024));
}

int render(const CLI::App& command, const Words& words, RenderOptions options) {
    options.scene = words.source();
    options.settings = words.settings;
    options.settings.method = *method_from_name(words.method);
    if (command.count("--max-depth"))
        options.max_depth = words.settings.max_depth;
    if (command.count("--spp"))
        options.spp = words.spp;
    if (command.count("--time"))
        options.time = words.time;
    options.clock = words.clock == "cpu" ? Clock::cpu : Clock::wall;
    if (!words.size.empty())
        options.size = parse_size("--size", words.size);
    if (command.count("--recon"))
        options.norms = parse_norms(words.norms);
    options.alpha = words.alpha;
    options.threads = words.threads;
    return run_render(options);
}

void add_render(CLI::App& app, Words& words, RenderOptions& options) {
    CLI::App& command = *app.add_subcommand("render", "render a scene to an EXR file");
    add_scene(command, words, true);
    add_settings(command, words);
    command.add_option("-m,--method", words.method, "pt, pr, gpt or gpr")
        ->check(CLI::IsMember({"pt", "pr", "gpt", "gpr"}))
        ->capture_default_str();
    command.add_option("--spp", words.spp, "samples a pixel (default 16)")->check(CLI::Range(1, 100000000));
    command.add_option("--time", words.time, "seconds of rendering, without loading")->check(CLI::PositiveNumber);
    command.add_option("--clock", words.clock, "what --time counts: wall or cpu")
        ->check(CLI::IsMember({"wall", "cpu"}))
        ->capture_default_str();
    command.add_option(
        "--recon", words.norms,
        "none, l2, l1, mixed, uniform, weighted, or several: one layer each (default weighted with gradients)");
    command.add_option("-o,--output", options.output, "file to write: EXR with all that is known, or PNG")
        ->required();
    command.add_option("--stats", options.stats, "JSON file for times, rays and counts");
    command.add_flag("--buffers", options.buffers, "primal, dx, dy and direct as layers of the EXR file, too");
}

void add_compare(CLI::App& app, CompareOptions& options) {
    CLI::App& command = *app.add_subcommand("compare", "errors of an image against one or two references");
    command.add_option("image", options.image, "EXR file")->required();
    command.add_option("reference", options.reference, "EXR file")->required();
    command.add_option("reference2", options.reference2, "an independent second one: errors without its noise");
    command.add_option("--layer", options.layer, "layer of the image to compare (default: its plain RGB)");
    command.add_flag("--json", options.json, "print JSON");
}

void add_view(CLI::App& app, Words& words, ViewOptions& options) {
    CLI::App& command = *app.add_subcommand("view", "explore a scene in a window");
    add_scene(command, words, false);
    add_settings(command, words);
    command.add_option("--spp", words.spp, "samples a pixel after which to rest")->check(CLI::Range(1, 100000000));
    command.add_option("--screenshot", options.screenshot,
                       "save the window as PNG when all panes have --spp, and quit");
    command.add_option("--window", words.window, "WIDTHxHEIGHT of the window, pixels");
    command.add_option("--seconds", words.seconds, "of rendering for each method, where there is no display")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_flag("--log-actions", options.log_actions, "print every change of a setting");
}

void add_sweep(CLI::App& app, Words& words, SweepOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "sweep", "error, time and efficiency by the values of settings, on scenes with references");
    command.footer(
        "Writes sweep.csv, sweep.json, sweep.md and sweep-SCENE.svg to the output folder, anew after each "
        "render. What is there of an earlier sweep is not continued, but replaced.\n"
        "References are REFERENCE/SCENE-WxH-dDEPTH-1.exr and -2.exr; missing ones are rendered first.");
    command.add_option("scenes", words.scenes, "Mitsuba scenes, XML")->required()->take_all();
    add_settings(command, words);
    command.get_option("--size")->description("WIDTHxHEIGHT of the images, pixels")->default_str("640x360");
    command.get_option("--max-depth")->default_str(std::to_string(words.settings.max_depth));
    command.get_option("--seed")->description("of the first render of each point");
    command
        .add_option("--vary", words.variations,
                    "SETTING=VALUE,VALUE,...: a setting and its values, such as tile=2,4,8; given twice: all "
                    "combinations")
        ->take_all()
        ->allow_extra_args(false);
    command.add_option("-m,--method", words.method, "pt, pr, gpt, gpr or several: gpr,pr")->capture_default_str();
    CLI::Option* spp = command.add_option("--spp", options.spp, "samples a pixel")
                           ->check(CLI::Range(1, 100000000))
                           ->capture_default_str();
    command.add_option("--time", words.time, "CPU seconds of rendering, instead of --spp")
        ->check(CLI::PositiveNumber)
        ->excludes(spp);
    command.add_option("--seeds", options.seeds, "renders of each point, each with another seed, in turn")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--recon", words.norms, "none, l2, l1, mixed, uniform or weighted, where there are gradients")
        ->default_str("weighted");
    command.add_option("--reference", options.references, "folder of the references")->required();
    command.add_option("--reference-spp", options.reference_spp, "samples a pixel of references that are missing")
        ->check(CLI::Range(1, 100000000))
        ->capture_default_str();
    command.add_option("-o,--output", options.output, "folder to write to")->required();
}

int sweep(const CLI::App& command, const Words& words, SweepOptions options) {
    options.scenes.assign(words.scenes.begin(), words.scenes.end());
    options.methods = parse_methods(words.method);
    if (words.variations.size() > 2)
        throw BadInput("--vary: two settings at the most");
    for (const std::string& text : words.variations)
        options.variations.push_back(parse_variation(text));
    if (options.variations.size() == 2 && options.variations[0].setting == options.variations[1].setting)
        throw BadInput(fmt::format("--vary {}: the setting is varied twice", words.variations[1]));
    options.settings = words.settings;
    if (command.count("--time"))
        options.time = words.time;
    if (!words.size.empty())
        options.size = parse_size("--size", words.size);
    if (command.count("--recon")) {
        const std::vector<Norm> norms = parse_norms(words.norms);
        if (norms.size() != 1)
            throw BadInput(fmt::format("--recon {}: one for all renders", words.norms));
        options.reconstruction.norm = norms.front();
    }
    options.reconstruction.alpha = words.alpha;
    options.threads = words.threads;
    return run_sweep(options);
}

/// Makes the scene of `source`, with `threads` threads, whenever it is called.
SceneLoader loader_of(const SceneSource& source, int threads) {
    return [source, threads](std::vector<std::string>& notes, LoadProgress& progress) {
        ThreadPool pool(threads);
        const OpenedScene opened = open_scene(source, pool, &progress);
        notes = group_notes(opened.notes);
        return opened.scene;
    };
}

int view(const CLI::App& command, const Words& words, ViewOptions options) {
    const SceneSource source = words.source();
    const int threads = words.threads;
    options.scene = {to_string(source), source.file, loader_of(source, threads)};
    options.open = [source, threads](const std::filesystem::path& file) {
        // Camera and variables were given for one scene, however it is named.
        std::error_code ignored;
        const bool same = !source.file.empty() && std::filesystem::equivalent(file, source.file, ignored);
        return loader_of(same ? source : SceneSource{file, {}, {}}, threads);
    };
    for (PaneSettings& pane : options.panes) {
        const Method method = pane.render.method;
        pane.render = words.settings;
        pane.render.method = method;
        pane.reconstruction.alpha = words.alpha;
    }
    if (command.count("--max-depth"))
        options.max_depth = words.settings.max_depth;
    if (!words.size.empty())
        options.render_size = {SizeChoice::Base::custom, 1, parse_size("--size", words.size)};
    if (!words.window.empty())
        options.window_size = parse_size("--window", words.window);
    options.threads = threads;
    options.spp = words.spp;
    const int result = run_view(options);
    if (result != view_needs_display)
        return result;
    ContactSheetOptions sheet;
    sheet.scene = source;
    sheet.threads = threads;
    sheet.seconds = words.seconds;
    if (!words.size.empty())
        sheet.size = parse_size("--size", words.size);
    if (!options.screenshot.empty())
        sheet.output = options.screenshot;
    fmt::print(stderr, "There is no display: rendering the viewer's comparison to {} instead.\n",
               sheet.output.string());
    return run_contact_sheet(sheet);
}

} // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app("Tessera: explore light transport by path reuse", "tessera");
    app.set_version_flag("--version", TESSERA_VERSION);
    // The last of a repeated option counts.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    Words render_words, sweep_words, view_words, info_words;
    RenderOptions render_options;
    SweepOptions sweep_options;
    CompareOptions compare_options;
    ViewOptions view_options;
    ReconstructWords reconstruct_words;
    add_view(app, view_words, view_options);
    add_render(app, render_words, render_options);
    add_sweep(app, sweep_words, sweep_options);
    add_reconstruct(app, reconstruct_words);
    add_compare(app, compare_options);
    CLI::App& info = *app.add_subcommand("info", "what a scene holds, and what of it is not understood");
    add_scene(info, info_words, true);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_bad_input;
    }
    if (app.get_subcommands().empty())
        throw BadInput("no command was given: view, render, reconstruct, sweep, compare or info (tessera --help)");
    if (app.got_subcommand("render"))
        return render(*app.get_subcommand("render"), render_words, render_options);
    if (app.got_subcommand("reconstruct"))
        return run_reconstruct(parse_reconstruct(reconstruct_words));
    if (app.got_subcommand("sweep"))
        return sweep(*app.get_subcommand("sweep"), sweep_words, sweep_options);
    if (app.got_subcommand("view"))
        return view(*app.get_subcommand("view"), view_words, view_options);
    if (app.got_subcommand("compare"))
        return run_compare(compare_options);
    if (app.got_subcommand("info"))
        return run_info(info_words.source());
    return exit_ok;
}

} // namespace tessera
