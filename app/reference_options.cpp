#include "app/reference_options.h"

#include "app/exit_codes.h"
#include "app/option_values.h"
#include "app/setting_options.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

void add_reference(CLI::App& app, ReferenceWords& words) {
    CLI::App& command = *app.add_subcommand("reference", "a reference for others to be compared with");
    command.footer(
        "A reference is two independent renders of the scene, with two seeds, which become the layers half1 and "
        "half2, and their mean, the plain RGB. From the difference of the halves its own error is known: that of "
        "the picture is printed and written to the header, each pixel's variance is the layer variance. What a "
        "biased reconstruction (l1, mixed, weighted) does to both halves alike is not in it. The header has the "
        "scene's checksums, too, by which others refuse it for another scene.\n"
        "OUTPUT.checkpoint is kept while it renders: after an interrupt or a kill the same command goes on from "
        "there, to the same bits.");
    ReferenceRecipe& recipe = words.options.recipe;
    command.add_option("scene", words.scene, "Mitsuba scene, XML")->required();
    command.add_option("-D", words.definitions, "name=value: replaces the <default> of that name")->take_all();
    command.add_option("--camera", words.camera, "JSON file with the camera to take, as saved in the viewer");
    add_picture_options(command,
                        {words.size, recipe.settings, recipe.reconstruction.alpha, words.options.threads});
    command.get_option("--seed")->description("of the first half; the second has the next");
    command.add_option("-m,--method", words.method, "pt, pr, gpt or gpr")
        ->check(CLI::IsMember({"pt", "pr", "gpt", "gpr"}))
        ->capture_default_str();
    command.add_option("--spp", recipe.spp, "samples a pixel, of both halves together; one more if odd")
        ->check(CLI::Range(2, 100000000))
        ->capture_default_str();
    command.add_option("--recon", words.norms, "norm as for render, where there are gradients (default l2)");
    command.add_option("--checkpoint", recipe.checkpoint_seconds, "seconds between checkpoints")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("-o,--output", words.options.output, "EXR file to write")->required();
}

ReferenceOptions parse_reference(const CLI::App& command, const ReferenceWords& words) {
    ReferenceOptions options = words.options;
    options.scene = {words.scene, parse_variables(words.definitions), words.camera};
    options.recipe.settings.method = *method_from_name(words.method);
    if (command.count("--max-depth"))
        options.max_depth = options.recipe.settings.max_depth;
    if (!words.size.empty())
        options.size = parse_size("--size", words.size);
    if (!words.norms.empty()) {
        const std::vector<Norm> norms = parse_norms(words.norms);
        if (norms.size() != 1)
            throw BadInput(fmt::format("--recon {}: one", words.norms));
        options.recipe.reconstruction.norm = norms.front();
    }
    return options;
}

} // namespace tessera
