#include "app/compare.h"

#include "recon/metrics.h"
#include "render/load/exr.h"

#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace tessera {

namespace {

struct Comparison {
    ErrorMetrics metrics;
    std::optional<FloorFreeError> floor_free;
    std::optional<std::array<double, 4>> energy_change;
};

RgbImage read_layer(const std::filesystem::path& path, const std::string& name) {
    return require_layer(read_exr(path), name, path);
}

RgbImage read_reference(const std::filesystem::path& path, const std::string& layer) {
    const ExrFile file = read_exr(path);
    const RgbImage* plain = find_layer(file, "");
    return plain ? *plain : read_layer(path, layer);
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

Comparison compare(const CompareOptions& options) {
    const RgbImage image = read_layer(options.image, options.layer);
    RgbImage reference = read_reference(options.reference, options.layer);
    check_size(options, image, options.reference, reference);
    Comparison result;
    if (!options.reference2.empty()) {
        const RgbImage second = read_reference(options.reference2, options.layer);
        check_size(options, image, options.reference2, second);
        result.floor_free = measure_floor_free_error(image, reference, second);
        result.energy_change = measure_energy_change(image, reference, second);
        for (std::size_t i = 0; i < reference.size(); ++i)
            reference.data()[i] = 0.5f * (reference.data()[i] + second.data()[i]);
    }
    result.metrics = measure_error(image, reference);
    return result;
}

void print_text(const Comparison& c) {
    std::printf("relMSE               %.6g\n", c.metrics.relative_mse);
    std::printf("relMSE, trimmed      %.6g   without the worst 0.01 %% of the pixels\n",
                c.metrics.relative_mse_trimmed);
    std::printf("MSE                  %.6g\n", c.metrics.mse);
    std::printf("MAPE                 %.6g\n", c.metrics.mape);
    std::printf("mean ratio           %.6f\n", c.metrics.mean_ratio);
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
    if (c.metrics.bad_pixels > 0)
        std::printf("pixels not finite    %zu\n", c.metrics.bad_pixels);
}

/// A figure that is not finite becomes null.
void print_json(const CompareOptions& options, const Comparison& c) {
    nlohmann::ordered_json out;
    out["image"] = options.image.string();
    out["layer"] = options.layer;
    out["reference"] = options.reference.string();
    if (c.floor_free)
        out["reference2"] = options.reference2.string();
    out["relmse"] = c.metrics.relative_mse;
    out["relmse_trimmed"] = c.metrics.relative_mse_trimmed;
    out["mse"] = c.metrics.mse;
    out["mape"] = c.metrics.mape;
    out["mean_ratio"] = c.metrics.mean_ratio;
    out["bad_pixels"] = c.metrics.bad_pixels;
    if (c.floor_free) {
        out["relmse_floor_free"] = c.floor_free->relative_mse;
        out["relmse_floor_free_standard_error"] = c.floor_free->standard_error;
        out["energy_change_by_quarter"] = *c.energy_change;
    }
    std::printf("%s\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

} // namespace

int run_compare(const CompareOptions& options) {
    try {
        const Comparison comparison = compare(options);
        if (options.json)
            print_json(options, comparison);
        else
            print_text(comparison);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tessera compare: %s\n", error.what());
        return 2;
    }
}

} // namespace tessera
