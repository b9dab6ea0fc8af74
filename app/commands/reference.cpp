#include "app/cli/opened_scene.h"
#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/files.h"
#include "render/run/reference_share.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

void add_reference(CLI::App& app, ReferenceArguments& words) {
    CLI::App& command = *app.add_subcommand("reference", "render a reference, with an estimate of its own error");
    command.footer(
        "A reference consists of two independent renders of the scene with two seeds, the layers half1 and "
        "half2, and of their mean, the plain RGB. The difference of the halves gives the reference's own "
        "error, which is printed and written to the header, and each pixel's variance, the layer variance. "
        "That error does not contain the bias of a biased reconstruction (all but none, l2 and uniform), "
        "which is the same in both halves. The layer doubt is each pixel's relative standard error, or 1 "
        "where the brightest sample is a firefly or no sample found radiance.\n"
        "The method (-m, by default G-PR) and the reconstruction (--recon, by default l2, which is linear and "
        "unbiased; none for methods without gradients) are printed and in the header. They do not depend on "
        "what is rendered. A bias of the judged method does not show against a reference by the same method: "
        "use -m pt to judge whether G-PR is unbiased.\n"
        "The header also has checksums of the scene; other commands refuse the reference for another scene.\n"
        "OUTPUT.checkpoint exists while the reference renders. After an interruption, the same command "
        "continues from there, to the same bits.");
    ReferenceRecipe& recipe = words.options.recipe;
    forbid_empty(command.add_option("scene", words.scene, "Mitsuba scene, XML"))->required();
    command.add_option("-D", words.definitions, "name=value: replaces the <default> of that name")->take_all();
    add_view_options(command, {words.camera, words.sensor, words.crop});
    add_picture_options(command, {words.size, recipe.settings, recipe.reconstruction, words.options.threads});
    add_strict(command, words.strict);
    add_alpha(command, recipe.reconstruction);
    command.get_option("--seed")->description("seed of the first half; the second half has the next seed");
    add_method(command, recipe.settings.method);
    add_setting(command, spp_setting(recipe.spp, 2))
        ->description("samples per pixel of both halves together; one more if odd");
    add_norm(command, recipe.reconstruction);
    limit(command.add_option("--checkpoint", recipe.checkpoint_seconds, "seconds between checkpoints"), 0,
          most_seconds)
        ->capture_default_str();
    command.add_option("--share", words.share,
                       "K/N: render shard K of N, on any machine; `tessera merge` merges the shards. OUTPUT is "
                       "not an EXR file then, and must end in .share");
    command.add_option("-o,--output", words.options.output, "EXR file to write")->required();
}

namespace {

PassShard parse_share(const std::string& text) {
    PassShard share;
    int end = 0;
    if (std::sscanf(text.c_str(), "%9d/%9d%n", &share.number, &share.count, &end) != 2 ||
        end != static_cast<int>(text.size()) || share.number < 1 || share.number > share.count)
        throw BadInput(fmt::format("--share {}: must be K/N, two whole numbers, K from 1 to N", text));
    return share;
}

} // namespace

ReferenceOptions parse_reference(const CLI::App& command, const ReferenceArguments& words) {
    ReferenceOptions options = words.options;
    options.scene = {words.scene, parse_variables(words.definitions), words.camera, words.strict, words.sensor,
                     {}};
    if (!words.crop.empty())
        options.scene.crop = parse_crop(words.crop, words.size);
    if (command.count("--max-depth"))
        options.max_depth = options.recipe.settings.max_depth;
    if (command.count("--size"))
        options.size = words.size;
    if (!words.share.empty()) {
        options.is_shard = true;
        options.recipe.share = parse_share(words.share);
    }
    return options;
}

namespace {

void print_error(const std::filesystem::path& output, const ReferenceImage& reference) {
    const FloorFreeError error = error_of(reference);
    fmt::print("{}: by {}; relMSE of the reference itself {:.3g} +- {:.2g}\n", output.string(),
               to_string(origin_of(reference)), error.relative_mse, error.standard_error);
    if (const double fraction = untrusted_fraction(reference.doubt); fraction > 0)
        fmt::print("{:.2g} % of its pixels are unreliable: their error is above {:g} %, their brightest "
                   "sample is a firefly, or no sample found radiance (layer doubt)\n",
                   100 * fraction, 100 * untrusted_threshold);
}

} // namespace

int run_reference(const ReferenceOptions& options) {
    check(options.recipe.settings);
    check_available({reconstruction_of(options.recipe).norm});
    const char* const extension = options.is_shard ? ".share" : ".exr";
    if (extension_of(options.output) != extension)
        throw BadInput(fmt::format("{}: the name must end in {}", options.output.string(), extension));
    passes_of(options.recipe);
    check_outputs({{"-o", options.output}},
                  {{"the scene", options.scene.file}, {"--camera", options.scene.camera}});
    check_writable(options.output);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    print_notes(opened.notes);
    ReferenceRecipe recipe = options.recipe;
    recipe.size = opened.scene->size(options.size);
    recipe.settings.max_depth = options.max_depth.value_or(std::min(opened.scene->max_depth(), most_edges));

    const InterruptGuard guard;
    bool is_complete = false;
    if (options.is_shard) {
        is_complete = render_shard(options.output, options.scene, opened.scene, recipe, pool);
    } else if (const auto reference =
                   render_reference(options.output, options.scene, opened.scene, recipe, pool)) {
        is_complete = true;
        print_error(options.output, *reference);
    }
    if (is_complete)
        return exit_ok;
    fmt::print(stderr, "{}: not complete; run the same command again to continue from its checkpoint\n",
               options.output.string());
    return exit_failure;
}

void add_merge(CLI::App& app, MergeOptions& options) {
    CLI::App& command = *app.add_subcommand("merge", "merge the shards of a reference");
    command.footer(
        "Shards are the files of `tessera reference --share K/N`, all N of them, in any order. They must have "
        "the same scene, camera, settings and program version; an error names a shard that is missing, "
        "duplicate or different. For a given N the result has the same bits, wherever and whenever its shards "
        "were rendered. N does not affect the bias. Takes memory for two shards, not for all.");
    command.add_option("shares", options.shares, "files of all shards")->required();
    command.add_option("-o,--output", options.output, "EXR file to write")->required();
}

int run_merge(const MergeOptions& options) {
    if (extension_of(options.output) != ".exr")
        throw BadInput(fmt::format("{}: the name must end in .exr", options.output.string()));
    std::vector<NamedFile> inputs;
    for (const std::filesystem::path& share : options.shares)
        inputs.push_back({"a share", share});
    check_outputs({{"-o", options.output}}, inputs);
    check_writable(options.output);
    print_error(options.output, merge_shards(options.shares, options.output));
    return exit_ok;
}

} // namespace tessera
