#include "app/cli/grouped_help.h"
#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "app/experiment/experiment.h"
#include "render/io/files.h"
#include "ui/viewer/script.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

namespace {

/// Command-line arguments before they are parsed.
struct Words {
    std::string scene, camera, sensor, crop, methods, norms, clock = "wall", sample;
    std::vector<std::string> definitions, scenes; ///< several scenes of `render`
    bool strict = false;
    glm::ivec2 size{0}, window{0}; ///< 0: not given
    int spp = 0;
    double time = 0;
    double seconds = ContactSheetOptions().seconds;
    int threads = 0;
    int panes = 2;
    RenderSettings settings;
    ReconstructionSettings reconstruction;

    SceneSource source() const { return source(scene); }
    SceneSource source(const std::string& file) const {
        return {file,   parse_variables(definitions),
                camera, strict,
                sensor, crop.empty() ? std::nullopt : std::optional(parse_crop(crop, size))};
    }
};

/// Adds the options that choose a view of a scene.
void add_view(CLI::App& command, Words& words) {
    command.add_option("-D", words.definitions, "name=value: replaces the <default> of that name")->take_all();
    add_view_options(command, {words.camera, words.sensor, words.crop});
}

void add_scene(CLI::App& command, Words& words, bool required) {
    forbid_empty(command.add_option("scene", words.scene, "Mitsuba scene, XML"))->required(required);
    add_view(command, words);
}

void add_settings(CLI::App& command, Words& words) {
    add_picture_options(command, {words.size, words.settings, words.reconstruction, words.threads});
    add_strict(command, words.strict);
}

int render(const CLI::App& command, const Words& words, RenderOptions options) {
    options.settings = words.settings;
    if (command.count("--max-depth"))
        options.max_depth = words.settings.max_depth;
    if (command.count("--spp"))
        options.spp = words.spp;
    if (command.count("--time"))
        options.time = words.time;
    options.clock = words.clock == "cpu" ? ClockChoice::cpu : ClockChoice::wall;
    if (command.count("--size"))
        options.size = words.size;
    if (command.count("--recon"))
        options.layers.norms = parse_norms(words.norms);
    options.layers.settings = words.reconstruction;
    options.threads = words.threads;
    std::vector<SceneSource> scenes;
    for (const std::string& file : words.scenes)
        scenes.push_back(words.source(file));
    return run_render(options, scenes);
}

/// Returns the version and the commit of the source, such as "0.2.0 (commit 1a2b3c4)". The commit ends with
/// "-dirty" if the source had changes when the build was configured. It is left out outside of a git checkout.
std::string version_text() {
    const std::string commit = TESSERA_COMMIT;
    return TESSERA_VERSION + (commit.empty() ? "" : " (commit " + commit + ")");
}

/// Returns the default reconstruction of each method, such as "pt none, gpr guided".
std::string default_norms() {
    std::string text;
    for (const Method method : all_methods)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", short_name(method),
                            to_string(default_norm(has_gradients(method))));
    return text;
}

void add_render(CLI::App& app, Words& words, RenderOptions& options) {
    CLI::App& command = *app.add_subcommand("render", "render a scene to an EXR file");
    forbid_empty(command.add_option("scene", words.scenes,
                                    "Mitsuba scenes, XML. Several: the name of each is added to OUTPUT, and "
                                    "after an error the next is rendered"))
        ->required()
        ->take_all();
    add_view(command, words);
    forbid_empty(command.add_option("--cameras", options.cameras,
                                    "JSON file with a list of cameras: one picture each. Its number, from 0, "
                                    "replaces #### in OUTPUT, or is added to it"))
        ->excludes("--camera");
    add_settings(command, words);
    add_method(command, words.settings.method);
    add_setting(command, spp_setting(words.spp))->default_str(std::to_string(default_spp));
    limit_to_seconds(command.add_option("--time", words.time, "render time in seconds, without loading"));
    add_clock(command, words.clock);
    add_norms(command, words.norms, "or several: one layer each (default: " + default_norms() + ")");
    add_pixel_format(command, options.format);
    command.add_option("-o,--output", options.output, "file to write: EXR, or PNG with the picture alone")
        ->required();
    command.add_option("--stats", options.stats, "JSON file for times, rays and counts");
    command.add_flag(
        "--buffers", options.layers.buffers,
        "also write everything that `tessera reconstruct` reads to the EXR file, such as gradients and variances; "
        "the feature buffers albedo, N, Z and roughness; and, with path reuse, maps of reused paths, shift "
        "outcomes, Russian roulette and samples");
    command.footer(
        "An EXR file has the reconstruction as plain RGB and the radiance as sampled, directly visible "
        "emission included, as the layer primal, unless the two are equal. The attribute "
        "tessera:redistributed has the fraction of the radiance that each reconstruction redistributed from "
        "fireflies, if any.");
}

void add_view(CLI::App& app, Words& words, ViewOptions& options) {
    CLI::App& command = *app.add_subcommand("view", "explore a scene in a window");
    add_scene(command, words, false);
    add_settings(command, words);
    add_setting(command, spp_setting(words.spp))
        ->description("samples per pixel at which the panes stop")
        ->default_str("");
    CLI::Option* panes = command.add_option("--panes", words.panes, "renders side by side: 1, 2 or 4")
                             ->check(CLI::IsMember({1, 2, 4}))
                             ->capture_default_str();
    add_methods(command, words.methods, "or up to four: gpr,pr; one pane each, instead of --panes")
        ->excludes(panes);
    command.add_option(
        "--inspect", words.sample,
        "X,Y,PASS: opens this sample in the path inspector, in the last pane; pixel and pass count from 0. The "
        "sample is that of a render with the same scene, -D, --camera, --sensor, --crop, --size, method, settings "
        "and --seed. "
        "Defaults are those of `tessera render`: one pane, G-PR, the scene's size");
    command.add_option("--reference", options.reference, "EXR file to show errors against");
    forbid_empty(
        command.add_option("--follow", options.jobs,
                           "output folder of a running bench, sweep or stability: shows its jobs and curves"));
    command.add_option("--screenshot", options.screenshot,
                       "save the window as PNG when all panes have --spp, and quit");
    command.add_flag("!--no-gallery", options.shows_gallery, "start without the gallery of scenes");
    command.add_option("--script", options.script, "file with script steps, one per line; -: standard input");
    command.footer("Steps of a script:\n" + script_help());
    Setting window = size_setting(words.window);
    window.id = "window";
    add_setting(command, window)->description("WIDTHxHEIGHT of the window, pixels")->default_str("");
    limit_to_seconds(command.add_option("--seconds", words.seconds,
                                        "seconds of rendering for each method, if there is no display"))
        ->capture_default_str();
    command.add_flag("--log-actions", options.log_actions, "print every change of a setting");
}

std::vector<PaneSettings> panes_of(const CLI::App& command, const Words& words) {
    const bool as_render = command.count("--inspect") > 0 && command.count("--panes") == 0;
    std::vector<PaneSettings> panes = default_panes(as_render ? 1 : words.panes);
    if (command.count("--method")) {
        const std::vector<Method> methods = parse_methods(words.methods);
        if (methods.size() > most_panes)
            throw BadInput(fmt::format("-m {}: at most {} methods, one for each pane", words.methods, most_panes));
        panes.resize(methods.size());
        for (std::size_t i = 0; i < methods.size(); ++i)
            panes[i].render.method = methods[i];
    }
    for (PaneSettings& pane : panes) {
        const Method method = pane.render.method;
        pane.render = words.settings;
        pane.render.method = method;
        pane.reconstruction = words.reconstruction;
    }
    return panes;
}

/// Returns the render size. A sample to inspect belongs to a picture of fixed size, independent of the window.
SizeChoice size_of(const Words& words) {
    const bool has_sample = !words.sample.empty();
    if (words.size == glm::ivec2(0))
        return {has_sample ? SizeChoice::Base::scene : SizeChoice::Base::pane};
    glm::ivec2 size = words.size;
    if (const Setting shown = size_setting(size, most_render_pixels_an_edge); !shown.is_allowed())
        throw BadInput(fmt::format("--size {}: in the viewer, it must be {}", shown.text(), shown.allowed()));
    // With --crop, --size is the film's.
    if (!words.crop.empty())
        size = parse_crop(words.crop, size).size_on(size);
    return {SizeChoice::Base::custom, 1, size};
}

int view(const CLI::App& command, const Words& words, ViewOptions options) {
    const SceneSource source = words.source();
    const int threads = words.threads;
    options.scene = origin_of(source, threads);
    options.open = [source, threads](const std::filesystem::path& file) {
        // The camera and the variables apply to one scene, under any of its names.
        std::error_code ignored;
        const bool same = !source.file.empty() && std::filesystem::equivalent(file, source.file, ignored);
        return origin_of(
            same ? SceneSource{file, source.variables, source.camera, source.strict, source.sensor, source.crop}
                 : SceneSource{file, {}, {}},
            threads);
    };
    options.panes = panes_of(command, words);
    options.uses_stored_pane_count =
        command.count("--panes") + command.count("--method") + command.count("--inspect") == 0;
    if (command.count("--max-depth"))
        options.max_depth = words.settings.max_depth;
    options.render_size = size_of(words);
    if (!words.sample.empty())
        options.sample = parse_sample("--inspect", words.sample);
    if (command.count("--window"))
        options.window_size = words.window;
    options.threads = threads;
    options.spp = words.spp;
    const int result = run_view(options);
    if (result != view_needs_display)
        return result;
    if (options.sample)
        throw BadInput(fmt::format("There is no display for --inspect {}", words.sample));
    ContactSheetOptions sheet;
    sheet.scene = source;
    sheet.threads = threads;
    sheet.seconds = words.seconds;
    sheet.size = words.size;
    if (!options.screenshot.empty())
        sheet.output = options.screenshot;
    fmt::print(stderr, "There is no display: rendering a contact sheet to {} instead.\n", sheet.output.string());
    return run_contact_sheet(sheet);
}

} // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app("Tessera: explore light transport by path reuse", "tessera");
    app.set_version_flag("--version", version_text());
    // A repeated option overrides the earlier ones.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    Words render_words, view_words, info_words;
    RenderOptions render_options;
    ExperimentArguments sweep_words, bench_words, stability_words;
    ReferenceArguments reference_arguments;
    MergeOptions merge_options;
    CompareArguments compare_words;
    ViewOptions view_options;
    ReconstructArguments reconstruct_words;
    add_view(app, view_words, view_options);
    add_render(app, render_words, render_options);
    add_reference(app, reference_arguments);
    add_merge(app, merge_options);
    add_sweep(app, sweep_words);
    add_bench(app, bench_words);
    add_stability(app, stability_words);
    add_reconstruct(app, reconstruct_words);
    add_compare(app, compare_words);
    CLI::App& info =
        *app.add_subcommand("info", "print the contents of a scene, and its parts that are not supported");
    add_scene(info, info_words, true);
    add_strict(info, info_words.strict);
    group_help(app);
    std::vector<const char*> words(argv, argv + argc);
    const bool is_alone = argc > 1 && (extension_of(argv[1]) == ".xml" || std::string_view(argv[1]) == "--follow");
    const bool has_display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
    if (is_alone || (argc == 1 && has_display)) // a scene, a folder, or nothing: open the viewer
        words.insert(words.begin() + 1, "view");
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_bad_input;
    }
    if (app.get_subcommands().empty())
        throw BadInput("no command was given: view, render, reconstruct, reference, merge, sweep, bench, "
                       "stability, compare or info (tessera --help)");
    if (app.got_subcommand("render"))
        return render(*app.get_subcommand("render"), render_words, render_options);
    if (app.got_subcommand("reconstruct"))
        return run_reconstruct(parse_reconstruct(reconstruct_words));
    if (app.got_subcommand("sweep"))
        return run_sweep(parse_experiment(*app.get_subcommand("sweep"), sweep_words));
    if (app.got_subcommand("bench"))
        return run_bench(parse_experiment(*app.get_subcommand("bench"), bench_words));
    if (app.got_subcommand("stability"))
        return run_stability(parse_experiment(*app.get_subcommand("stability"), stability_words));
    if (app.got_subcommand("reference"))
        return run_reference(parse_reference(*app.get_subcommand("reference"), reference_arguments));
    if (app.got_subcommand("merge"))
        return run_merge(merge_options);
    if (app.got_subcommand("view"))
        return view(*app.get_subcommand("view"), view_words, view_options);
    if (app.got_subcommand("compare"))
        return run_compare(parse_compare(compare_words));
    if (app.got_subcommand("info"))
        return run_info(info_words.source());
    return exit_ok;
}

} // namespace tessera
