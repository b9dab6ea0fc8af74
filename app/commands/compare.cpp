#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "app/compare/comparison_report.h"
#include "app/compare/picture_comparison.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/picture_file.h"
#include "render/run/reference_image.h"

#include <cstdio>
#include <exception>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Reads a picture and prints its notes. Errors name the option that chooses a layer.
NamedPicture read_named(const std::filesystem::path& path, const std::string& layer, const char* option) {
    try {
        NamedPicture named{path, read_picture(path, layer)};
        for (const std::string& note : named.picture.notes)
            fmt::print(stderr, "note: {}: {}\n", path.string(), note);
        return named;
    } catch (const std::exception& error) {
        const std::string message = message_of(error);
        const bool has_layers = message.find("its channels are") != message.npos;
        throw BadInput(has_layers ? fmt::format("{}; choose a layer, PART or PART:LAYER with {}", message, option)
                                  : message);
    }
}

NamedPicture whole_picture(const std::filesystem::path& path, RgbImage image) {
    const PixelRect rect{0, 0, image.width(), image.height()};
    return {path, {std::move(image), rect, rect}};
}

References read_references(const CompareOptions& options) {
    const std::string& layer = options.reference_layer;
    if (!options.reference2.empty())
        return {read_named(options.reference, layer, "--reference-layer"),
                read_named(options.reference2, layer, "--reference-layer")};
    if (layer.empty() && is_reference(options.reference)) {
        ReferenceImage reference = read_reference(options.reference);
        return {whole_picture(options.reference, std::move(reference.halves[0])),
                whole_picture(options.reference, std::move(reference.halves[1]))};
    }
    return {read_named(options.reference, layer, "--reference-layer"), {}};
}

/// Compares one picture, prints notes and warnings, and writes its maps.
ComparedPicture compare_one(const CompareOptions& options, std::size_t index, const References& references) {
    const std::filesystem::path& path = options.images[index];
    const AlignedPictures aligned = align(read_named(path, options.layer, "--layer"), references);
    for (const std::string& note : aligned.notes)
        fmt::print(stderr, "note: {}\n", note);
    ComparedPicture compared{path, {}};
    try {
        compared.errors = compare_pictures(aligned, options.tile);
    } catch (const std::exception& error) {
        throw BadInput(fmt::format("{}: {}", path.string(), message_of(error)));
    }
    const PictureComparison& c = compared.errors;
    if (c.invalid > 0)
        fmt::print(
            stderr,
            "warning: {}: {} of {} pixels are left out of all errors: they are not finite, {} of them in the "
            "picture, the others in the reference\n",
            path.string(), c.invalid, c.pixels, c.image_invalid);
    for (const MapFile& map : options.maps)
        write_map(map_path(map, index, options.images.size()), map.kind, aligned);
    return compared;
}

std::string text_of(const CompareOptions& options, const std::vector<ComparedPicture>& pictures) {
    const ComparisonInputs inputs{options.layer, options.reference, options.reference2};
    if (options.format == ComparisonFormat::json)
        return to_json(inputs, pictures);
    if (options.format == ComparisonFormat::csv)
        return to_csv(inputs, pictures);
    return options.images.size() == 1 ? to_text(pictures.front().errors) : to_table(pictures);
}

void print_error(const std::exception& error) {
    fmt::print(stderr, "tessera compare: {}\n", message_of(error));
}

} // namespace

int run_compare(const CompareOptions& options) {
    std::vector<ComparedPicture> pictures;
    try {
        const References references = read_references(options);
        for (std::size_t i = 0; i < options.images.size(); ++i)
            try {
                pictures.push_back(compare_one(options, i, references));
            } catch (const std::exception& error) {
                print_error(error);
            }
    } catch (const std::exception& error) {
        print_error(error);
    }
    if (!pictures.empty())
        fmt::print("{}", text_of(options, pictures));
    return pictures.size() == options.images.size() ? exit_ok : exit_bad_input;
}

} // namespace tessera
