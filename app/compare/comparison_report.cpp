#include "app/compare/comparison_report.h"

#include "app/report/reports.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the errors by their names in JSON and CSV. Those that need two references or tiles are NaN without
/// them.
std::vector<std::pair<const char*, double>> numbers_of(const PictureComparison& c) {
    return {{"relmse", c.metrics.relative_mse},
            {"relmse_trimmed", c.metrics.relative_mse_trimmed},
            {"mse", c.metrics.mse},
            {"mape", c.metrics.mape},
            {"mean_ratio", c.metrics.mean_ratio},
            {"psnr", c.psnr},
            {"flip", c.flip},
            {"pixels", static_cast<double>(c.pixels)},
            {"bad_pixels", static_cast<double>(c.image_invalid)},
            {"left_out_pixels", static_cast<double>(c.invalid)},
            {"share_without_light", c.without_light},
            {"relmse_floor_free", c.floor_free ? c.floor_free->relative_mse : nan},
            {"relmse_floor_free_standard_error", c.floor_free ? c.floor_free->standard_error : nan}};
}

nlohmann::ordered_json json_of(const ComparisonInputs& inputs, const ComparedPicture& picture) {
    const PictureComparison& c = picture.errors;
    nlohmann::ordered_json out;
    out["image"] = picture.path.string();
    out["layer"] = inputs.layer;
    out["reference"] = inputs.reference.string();
    if (!inputs.reference2.empty())
        out["reference2"] = inputs.reference2.string();
    for (const auto& [name, value] : numbers_of(c)) {
        const bool is_count = std::string_view(name).ends_with("pixels");
        if (is_count)
            out[name] = static_cast<std::size_t>(value);
        else if (c.floor_free || !std::string_view(name).starts_with("relmse_floor_free"))
            out[name] = value;
    }
    if (std::isinf(c.psnr))
        out["psnr"] = "inf"; // JSON has no infinity, and null would mean that it is not known
    if (c.energy_change)
        out["energy_change_by_quarter"] = *c.energy_change;
    if (c.tiles)
        out["tiles"] = {{"error", c.tiles->error}, {"edges", c.tiles->edges}, {"edge_ratio", c.tiles->edge_ratio}};
    return out;
}

} // namespace

std::string to_text(const PictureComparison& c) {
    std::string text;
    const auto add = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<21}{}\n", name, value);
    };
    add("relMSE", fmt::format("{:.6g}", c.metrics.relative_mse));
    add("relMSE, trimmed",
        fmt::format("{:.6g}   without the worst 0.01 % of the pixels", c.metrics.relative_mse_trimmed));
    add("MSE", fmt::format("{:.6g}", c.metrics.mse));
    add("MAPE", fmt::format("{:.6g}", c.metrics.mape));
    add("mean ratio", fmt::format("{:.6f}", c.metrics.mean_ratio));
    add("PSNR", fmt::format("{:.2f} dB   as shown on a screen (sRGB, exposure 0)", c.psnr));
    add("FLIP", fmt::format("{:.4f}   mean, as shown on a screen", c.flip));
    if (c.floor_free)
        add("relMSE, floor-free",
            fmt::format("{:.6g} +- {:.2g}   mean of (I - r1)(I - r2) / (r^2 + {:g})", c.floor_free->relative_mse,
                        c.floor_free->standard_error, relative_mse_epsilon));
    if (c.energy_change) {
        const std::array<double, 4> change = *c.energy_change;
        add("energy",
            fmt::format("{:+.2f} % {:+.2f} % {:+.2f} % {:+.2f} %   by quarters of the pixels, from dark to bright",
                        100 * change[0], 100 * change[1], 100 * change[2], 100 * change[3]));
    }
    if (c.tiles) {
        add("tiles, in error",
            fmt::format("{:.4g}   power at multiples of the tile frequency, over that at neighbouring frequencies",
                        c.tiles->error));
        add("tiles, in edges",
            fmt::format(
                "{:.4g}   the same ratio for squared differences of neighbours, averaged over rows and columns",
                c.tiles->edges));
        add("tiles, edge ratio",
            fmt::format("{:.4g}   largest squared difference by position in the tile, over the others",
                        c.tiles->edge_ratio));
    }
    add("without light", fmt::format("{:.3g} %   of the pixels: luminance 0 or less", 100 * c.without_light));
    if (c.invalid > 0)
        add("pixels not finite", fmt::format("{} of {}   left out of all errors", c.invalid, c.pixels));
    return text;
}

std::string to_table(const std::vector<ComparedPicture>& pictures) {
    std::size_t width = 7;
    bool has_floor_free = false, has_invalid = false;
    for (const ComparedPicture& p : pictures) {
        width = std::max(width, p.path.string().size());
        has_floor_free |= p.errors.floor_free.has_value();
        has_invalid |= p.errors.invalid > 0;
    }
    std::string text = fmt::format("{:<{}}  {:>11}  {:>11}  {:>11}  {:>10}  {:>8}  {:>6}", "picture", width,
                                   "relMSE", "MSE", "MAPE", "mean ratio", "PSNR, dB", "FLIP");
    text += fmt::format("{}{}\n", has_floor_free ? "   floor-free relMSE" : "", has_invalid ? "  left out" : "");
    for (const ComparedPicture& p : pictures) {
        const PictureComparison& c = p.errors;
        text += fmt::format("{:<{}}  {:>11.6g}  {:>11.6g}  {:>11.6g}  {:>10.6f}  {:>8.2f}  {:>6.4f}",
                            p.path.string(), width, c.metrics.relative_mse, c.metrics.mse, c.metrics.mape,
                            c.metrics.mean_ratio, c.psnr, c.flip);
        if (has_floor_free)
            text += c.floor_free ? fmt::format("  {:>8.4g} +- {:<7.2g}", c.floor_free->relative_mse,
                                               c.floor_free->standard_error)
                                 : fmt::format("  {:>19}", "");
        text += has_invalid ? fmt::format("  {:>8}\n", c.invalid) : "\n";
    }
    return text;
}

std::string to_json(const ComparisonInputs& inputs, const std::vector<ComparedPicture>& pictures) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const ComparedPicture& picture : pictures)
        all.push_back(json_of(inputs, picture));
    return to_text(pictures.size() == 1 ? all.front() : all, 2) + "\n";
}

std::string to_csv(const ComparisonInputs& inputs, const std::vector<ComparedPicture>& pictures) {
    std::string text = "image,layer,reference,reference2";
    for (const auto& [name, value] : numbers_of({}))
        text += fmt::format(",{}", name);
    text += "\n";
    for (const ComparedPicture& picture : pictures) {
        text += csv_cell(picture.path.string()) + "," + csv_cell(inputs.layer) + "," +
                csv_cell(inputs.reference.string()) + "," + csv_cell(inputs.reference2.string());
        for (const auto& [name, value] : numbers_of(picture.errors))
            text += std::isnan(value) ? "," : fmt::format(",{:.7g}", value);
        text += "\n";
    }
    return text;
}

} // namespace tessera
