#include "app/commands/commands.h"
#include "app/experiment/artefacts.h"
#include "recon/metrics/metrics.h"
#include "recon/metrics/seen_error.h"
#include "render/io/available_memory.h"
#include "render/io/exr.h"
#include "render/io/json_text.h"
#include "render/run/reference_image.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

struct ImageComparison {
    ErrorMetrics metrics;
    double psnr = 0, flip = 0; // recon/metrics/seen_error.h
    std::optional<FloorFreeError> floor_free;
    std::optional<std::array<double, 4>> energy_change;
    std::optional<TileSpectrum> tiles;
    double fraction_without_light = 0; ///< fraction of the pixels with a luminance of 0 or less
};

RgbImage read_layer(const std::filesystem::path& path, const std::string& name) {
    return require_layer(read_exr(path), name, path);
}

RgbImage read_plain(const std::filesystem::path& path, const std::string& layer) {
    const ExrFile file = read_exr(path);
    const RgbImage* plain = find_layer(file, "");
    return plain ? *plain : read_layer(path, layer);
}

/// One reference, or two independent ones.
struct References {
    RgbImage first;
    std::optional<RgbImage> second;
};

References read_references(const CompareOptions& options) {
    if (!options.reference2.empty())
        return {read_plain(options.reference, options.layer), read_plain(options.reference2, options.layer)};
    if (is_reference(options.reference)) {
        ReferenceImage reference = read_reference(options.reference);
        return {std::move(reference.halves[0]), std::move(reference.halves[1])};
    }
    return {read_plain(options.reference, options.layer), {}};
}

double fraction_without_light(const RgbImage& image) {
    const auto dark = std::count_if(image.begin(), image.end(), [](Rgb c) { return luminance(c) <= 0; });
    return static_cast<double>(dark) / static_cast<double>(image.size());
}

void check_size(const CompareOptions& options, const RgbImage& image, const std::filesystem::path& path,
                const RgbImage& reference) {
    if (image.width() == reference.width() && image.height() == reference.height())
        return;
    const auto size = [](const RgbImage& i) {
        return std::to_string(i.width()) + "x" + std::to_string(i.height());
    };
    throw std::runtime_error("sizes differ: " + options.image.string() + " is " + size(image) + ", " +
                             path.string() + " is " + size(reference));
}

ImageComparison compare(const CompareOptions& options) {
    const RgbImage image = read_layer(options.image, options.layer);
    References references = read_references(options);
    check_size(options, image, options.reference, references.first);
    ImageComparison result;
    if (references.second) {
        check_size(options, image, options.reference2, *references.second);
        result.floor_free = measure_floor_free_error(image, references.first, *references.second);
        result.energy_change = measure_energy_change(image, references.first, *references.second);
        result.psnr = psnr(image, references.first, *references.second);
        references.first = mean_of(references.first, *references.second);
    } else {
        result.psnr = psnr(image, references.first, references.first);
    }
    result.metrics = measure_error(image, references.first);
    result.flip = mean_flip(image, references.first);
    if (options.tile > 0) {
        if (options.tile < 2 || std::min(image.width(), image.height()) < 4 * options.tile)
            throw std::runtime_error(
                options.image.string() +
                ": a tile spectrum needs tiles of at least 2 pixels, and 4 tiles along each edge");
        result.tiles = measure_tile_spectrum(image, references.first, options.tile);
    }
    result.fraction_without_light = fraction_without_light(image);
    return result;
}

void print_text(const ImageComparison& c) {
    std::printf("relMSE               %.6g\n", c.metrics.relative_mse);
    std::printf("relMSE, trimmed      %.6g   without the worst 0.01 %% of the pixels\n",
                c.metrics.relative_mse_trimmed);
    std::printf("MSE                  %.6g\n", c.metrics.mse);
    std::printf("MAPE                 %.6g\n", c.metrics.mape);
    std::printf("mean ratio           %.6f\n", c.metrics.mean_ratio);
    std::printf("PSNR                 %.2f dB   as shown on a screen (sRGB, exposure 0)\n", c.psnr);
    std::printf("FLIP                 %.4f   mean, as shown on a screen\n", c.flip);
    if (c.floor_free)
        std::printf("relMSE, floor-free   %.6g +- %.2g   mean of (I - r1)(I - r2) / (r^2 + %g)\n",
                    c.floor_free->relative_mse, c.floor_free->standard_error, relative_mse_epsilon);
    if (c.energy_change) {
        const std::array<double, 4> change = *c.energy_change;
        std::printf(
            "energy               %+.2f %% %+.2f %% %+.2f %% %+.2f %%   by quarters of the pixels, from dark "
            "to bright\n",
            100 * change[0], 100 * change[1], 100 * change[2], 100 * change[3]);
    }
    if (c.tiles) {
        std::printf("tiles, in error      %.4g   power at multiples of the tile frequency, over that at "
                    "neighbouring frequencies\n",
                    c.tiles->error);
        std::printf("tiles, in edges      %.4g   the same ratio for squared differences of neighbours, averaged "
                    "over rows and columns\n",
                    c.tiles->edges);
        std::printf(
            "tiles, edge ratio    %.4g   largest squared difference by position in the tile, over the others\n",
            c.tiles->edge_ratio);
    }
    std::printf("without light        %.3g %%   of the pixels: luminance 0 or less\n",
                100 * c.fraction_without_light);
    if (c.metrics.bad_pixels > 0)
        std::printf("pixels not finite    %zu\n", c.metrics.bad_pixels);
}

/// Prints all values; those that are not finite become null.
void print_json(const CompareOptions& options, const ImageComparison& c) {
    nlohmann::ordered_json out;
    out["image"] = options.image.string();
    out["layer"] = options.layer;
    out["reference"] = options.reference.string();
    if (!options.reference2.empty())
        out["reference2"] = options.reference2.string();
    out["relmse"] = c.metrics.relative_mse;
    out["relmse_trimmed"] = c.metrics.relative_mse_trimmed;
    out["mse"] = c.metrics.mse;
    out["mape"] = c.metrics.mape;
    out["mean_ratio"] = c.metrics.mean_ratio;
    out["psnr"] = c.psnr;
    out["flip"] = c.flip;
    out["bad_pixels"] = c.metrics.bad_pixels;
    out["share_without_light"] = c.fraction_without_light;
    if (c.floor_free) {
        out["relmse_floor_free"] = c.floor_free->relative_mse;
        out["relmse_floor_free_standard_error"] = c.floor_free->standard_error;
        out["energy_change_by_quarter"] = *c.energy_change;
    }
    if (c.tiles)
        out["tiles"] = {{"error", c.tiles->error}, {"edges", c.tiles->edges}, {"edge_ratio", c.tiles->edge_ratio}};
    std::printf("%s\n", to_text(out, 2).c_str());
}

} // namespace

int run_compare(const CompareOptions& options) {
    try {
        const ImageComparison comparison = compare(options);
        if (options.json)
            print_json(options, comparison);
        else
            print_text(comparison);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tessera compare: %s\n", message_of(error).c_str());
        return 2;
    }
}

} // namespace tessera
