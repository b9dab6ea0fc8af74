#include "app/reconstruct_options.h"

#include "app/option_values.h"

#include <CLI/CLI.hpp>

namespace tessera {

namespace {

void add_inputs(CLI::App& command, ReconstructWords& words) {
    CLI::Option* inputs =
        command
            .add_option("inputs", words.inputs,
                        "an EXR file as `tessera render --buffers` writes it; or primal, dx, dy and, if there is "
                        "any, very direct light: EXR or PFM files, in this order")
            ->take_all();
    CLI::Option* primal = command.add_option("--primal", words.primal, "the inputs by their names instead");
    CLI::Option* dx = command.add_option("--dx", words.dx, "differences to the right");
    CLI::Option* dy = command.add_option("--dy", words.dy, "differences downward");
    CLI::Option* direct = command.add_option("--direct", words.direct, "very direct light, added after the solve");
    primal->needs(dx)->needs(dy)->excludes(inputs);
    for (CLI::Option* option : {dx, dy, direct})
        option->needs(primal)->excludes(inputs);
}

} // namespace

void add_reconstruct(CLI::App& app, ReconstructWords& words) {
    CLI::App& command = *app.add_subcommand("reconstruct", "a picture from saved buffers, of any program");
    command.footer("The gradients are dx(x,y) = I(x+1,y) - I(x,y) and dy(x,y) = I(x,y+1) - I(x,y), with y counted "
                   "downward; other programs may mean others. dx may be a column narrower than the primal, and dy "
                   "a row lower: the last column of dx and the last row of dy count as 0 in any case.\n"
                   "Of an EXR file with several layers, the plain RGB is a reconstruction, and is not used.");
    ReconstructOptions& options = words.options;
    add_inputs(command, words);
    command.add_option("--recon", words.norms, "norms as for render; of several, each has a layer")
        ->capture_default_str();
    command.add_option("--alpha", options.layers.alpha, "weight of the primal against the gradients")
        ->check(CLI::Range(1e-4, 1e3))
        ->capture_default_str();
    command.add_flag("--per-channel", options.layers.per_channel,
                     "l1 and mixed: absolute values of each channel, not lengths of colours");
    command.add_option("--threads", options.threads, "0: one a hardware thread")->check(CLI::Range(0, 1024));
    command.add_option("-o,--output", options.output, "file to write: EXR, or PNG with the picture alone")
        ->required();
    command.add_option("--stats", options.stats, "JSON file for times and residuals");
    command.add_flag("--buffers", options.layers.buffers,
                     "primal, dx, dy, direct and the variances as layers of the EXR file, too");
    command.add_flag("--repair", options.repair, "take pixels that are not finite as 0, and say how many");
}

ReconstructOptions parse_reconstruct(const ReconstructWords& words) {
    ReconstructOptions options = words.options;
    options.inputs.assign(words.inputs.begin(), words.inputs.end());
    if (!words.primal.empty())
        options.inputs = {words.primal, words.dx, words.dy};
    if (!words.direct.empty())
        options.inputs.push_back(words.direct);
    options.layers.norms = parse_norms(words.norms);
    return options;
}

} // namespace tessera
