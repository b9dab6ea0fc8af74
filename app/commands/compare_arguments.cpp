#include "app/cli/option_values.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace tessera {

void add_compare(CLI::App& app, CompareArguments& words) {
    CLI::App& command =
        *app.add_subcommand("compare", "measure the errors of pictures against one or two references");
    command.footer(
        "Pictures are OpenEXR, PNG, JPEG, BMP, TGA, Radiance (.hdr) or PFM files; the codes of PNG, JPEG, BMP and "
        "TGA "
        "are sRGB. Pictures with crop windows are compared where they overlap in display coordinates. Pixels that "
        "are "
        "not finite are counted, and left out of all errors.\n"
        "In an OpenEXR file the picture is the colour (R, G, B; X, Y, Z; or Y, RY, BY) without a layer name, else "
        "a "
        "lone Y, else the only colour layer, else the only channel; of several, the one that is called beauty, "
        "combined, rgba or rgb. --layer and --reference-layer choose another one by LAYER, PART, PART:LAYER or "
        "the "
        "name of one channel; parts may be given by their number, from 0.\n"
        "Without --reference, the second file is the reference, and a third is its second one.");
    CompareOptions& options = words.options;
    command.add_option("files", words.files, "pictures; without --reference: PICTURE REFERENCE [REFERENCE2]")
        ->take_all()
        ->required();
    CLI::Option* reference = command.add_option("--reference", options.reference, "reference of all pictures");
    command
        .add_option(
            "--reference2", options.reference2,
            "second, independent reference, if the first has no halves: errors exclude the noise of references")
        ->needs(reference);
    command.add_option("--layer", options.layer,
                       "layer of the pictures (default: the colour without a layer name)");
    command.add_option("--reference-layer", options.reference_layer, "layer of the references");
    command
        .add_option(
            "--map", words.maps,
            "KIND=FILE: writes the error of each pixel, as EXR (values) or PNG (false colours); the kind is "
            "squared, relative, flip or difference. For several pictures the names get numbers. May be repeated")
        ->allow_extra_args(false)
        ->take_all();
    limit(command.add_option(
              "--tile", options.tile,
              "tile edge, pixels: prints three ratios that show the tile grid in the error (about 1: no grid)"),
          2, 64);
    CLI::Option* json = command.add_flag("--json", words.json, "print JSON");
    command.add_flag("--csv", words.csv, "print CSV")->excludes(json);
}

CompareOptions parse_compare(const CompareArguments& words) {
    CompareOptions options = words.options;
    options.images.assign(words.files.begin(), words.files.end());
    if (options.reference.empty()) {
        if (words.files.size() < 2 || words.files.size() > 3)
            throw BadInput(
                fmt::format("{}: give PICTURE REFERENCE [REFERENCE2], or --reference FILE for any number of "
                            "pictures",
                            words.files.size() < 2 ? "there is no reference" : "more than three files"));
        options.images.resize(1);
        options.reference = words.files[1];
        options.reference2 = words.files.size() == 3 ? words.files[2] : "";
    }
    for (const std::string& map : words.maps)
        options.maps.push_back(parse_map(map));
    if (words.json || words.csv)
        options.format = words.json ? ComparisonFormat::json : ComparisonFormat::csv;
    return options;
}

} // namespace tessera
