#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/json_text.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

void add_inputs(CLI::App& command, ReconstructArguments& words) {
    CLI::Option* inputs =
        command
            .add_option("inputs", words.inputs,
                        "an EXR file as `tessera render --buffers` writes it; or primal, dx, dy and, if there is "
                        "any, directly visible emission: EXR or PFM files, in this order")
            ->take_all();
    CLI::Option* primal = command.add_option("--primal", words.primal,
                                             "primal, with --dx and --dy instead of the positional inputs");
    CLI::Option* dx = command.add_option("--dx", words.dx, "differences to the right");
    CLI::Option* dy = command.add_option("--dy", words.dy, "differences downward");
    CLI::Option* direct =
        command.add_option("--direct", words.direct,
                           "directly visible emission, which the primal does not contain; added to the result");
    primal->needs(dx)->needs(dy)->excludes(inputs);
    for (CLI::Option* option : {dx, dy, direct})
        option->needs(primal)->excludes(inputs);
}

} // namespace

void add_reconstruct(CLI::App& app, ReconstructArguments& words) {
    CLI::App& command =
        *app.add_subcommand("reconstruct", "reconstruct a picture from saved buffers of any program");
    command.footer(
        "The gradients are dx(x,y) = I(x+1,y) - I(x,y) and dy(x,y) = I(x,y+1) - I(x,y), with y counted downward; "
        "other programs may define them differently. dx may be a column narrower than the primal, and dy a row "
        "lower: the last column of dx and the last row of dy count as 0 in any case.\n"
        "One EXR file needs the layers primal_without_direct (radiance without directly visible emission), dx and "
        "dy, or coefficient, coefficient_dx and coefficient_dy, and the layer direct if there is such emission; "
        "without a layer direct, primal may replace primal_without_direct. Its plain RGB is a reconstruction and "
        "is not used.");
    ReconstructOptions& options = words.options;
    add_inputs(command, words);
    add_norms(command, words.norms, "or several: one layer each")->capture_default_str();
    add_alpha(command, options.layers.settings);
    add_setting(command, threads_setting(options.threads));
    command.add_option("-o,--output", options.output, "file to write: EXR, or PNG with the picture alone")
        ->required();
    command.add_option("--stats", options.stats, "JSON file for times and residuals");
    command.add_flag("--buffers", options.layers.buffers, "also write the input's buffers to the EXR file");
    command.add_flag("--repair", options.repair, "set pixels that are not finite to 0, and print how many");
}

ReconstructOptions parse_reconstruct(const ReconstructArguments& words) {
    ReconstructOptions options = words.options;
    options.inputs.assign(words.inputs.begin(), words.inputs.end());
    if (!words.primal.empty())
        options.inputs = {words.primal, words.dx, words.dy};
    if (!words.direct.empty())
        options.inputs.push_back(words.direct);
    options.layers.norms = parse_norms(words.norms);
    return options;
}

namespace {

using nlohmann::json;

/// Returns all options that determine the picture, in addition to the input's header.
json reconstruction_json(const ReconstructOptions& options, const GradientInput& input) {
    json files = json::array(), norms = json::array();
    for (const std::filesystem::path& file : options.inputs)
        files.push_back(file.string());
    for (Norm norm : options.layers.norms)
        norms.push_back(to_string(norm));
    return {{"version", TESSERA_VERSION},
            {"inputs", files},
            {"width", input.images.primal.width()},
            {"height", input.images.primal.height()},
            {"norms", norms},
            {"alpha", options.layers.settings.alpha},
            {"repaired_pixels", input.repaired}};
}

void check_finite(const ExrFile& file, const std::filesystem::path& input) {
    for (const ExrLayer& layer : file.layers)
        if (const std::string bad = text_of_bad_pixel(layer.image); !bad.empty())
            throw BadInput(
                fmt::format("{}: the values are too large to reconstruct from: {}", input.string(), bad));
}

} // namespace

int run_reconstruct(const ReconstructOptions& options) {
    check_available(options.layers.norms);
    check_picture_name(options.output, options.layers);
    check_outputs({{"-o", options.output}, {"--stats", options.stats}}, {}); // the output may replace an input
    check_writable(options.output);
    if (!options.stats.empty())
        check_writable(options.stats);

    const auto start = std::chrono::steady_clock::now();
    const double start_cpu = process_cpu_seconds();
    GradientInput input = read_gradients(options.inputs, options.repair);
    const double load_cpu = process_cpu_seconds() - start_cpu;
    const double load_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (input.repaired > 0)
        fmt::print(stderr, "warning: invalid values (not finite, or negative variances), repaired: {}\n",
                   input.repaired);

    const json settings = reconstruction_json(options, input);
    ThreadPool pool(options.threads);
    std::vector<ReconstructionStats> recon;
    ExrFile file = reconstruct_layers(std::move(input.images), options.layers, pool, recon);
    check_finite(file, options.inputs.front());
    for (const auto& [name, text] : input.attributes)
        file.attributes[name] = text;
    record_redistributed(file, recon);
    file.attributes["tessera:reconstruction"] = to_text(settings);
    write_picture(options.output, file);
    if (!options.stats.empty()) {
        const json stats{
            {"settings", settings},
            {"threads", pool.size()},
            {"seconds",
             {{"load", {{"wall", load_wall}, {"cpu", load_cpu}}}, {"reconstruct", reconstructions_json(recon)}}},
            {"peak_memory", peak_memory_bytes()}};
        write_text(options.stats, to_text(stats, 2) + "\n");
    }
    for (const ReconstructionStats& r : recon)
        fmt::print(stderr, "{}: {} in {:.3f} s ({:.3f} CPU s)\n", options.output.string(), to_string(r.norm),
                   r.seconds, r.cpu_seconds);
    print_redistributed(options.output, recon);
    return exit_ok;
}

} // namespace tessera
