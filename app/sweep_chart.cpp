#include "app/sweep_chart.h"

#include <algorithm>

#include <fmt/core.h>

namespace tessera {

namespace {

std::string title(const SweepOptions& options, const std::string& scene) {
    const std::string effort =
        options.time ? fmt::format("{:g} CPU s", *options.time) : fmt::format("{} spp", options.spp);
    return fmt::format("{}: {}x{}, {}{}", scene, options.size.x, options.size.y, effort,
                       options.seeds > 1 ? fmt::format(", {} seeds", options.seeds) : "");
}

/// The numbers of a variation; empty if it is one of words.
std::vector<double> numbers_of(const Variation& variation) {
    std::vector<double> numbers;
    RenderSettings settings;
    for (const std::string& value : variation.values) {
        variation.setting->set_text(settings, value);
        if (const auto* whole = std::get_if<Setting::Whole>(&variation.setting->kind))
            numbers.push_back(settings.*whole->member);
        else if (const auto* real = std::get_if<Setting::Real>(&variation.setting->kind))
            numbers.push_back(settings.*real->member);
    }
    return numbers;
}

/// What the plots have along x.
struct Abscissa {
    std::string label;
    std::vector<std::string> values;
    std::vector<double> numbers; ///< places of the values
    ChartAxis::Scale scale = ChartAxis::Scale::linear;
    bool has_names = true;

    double at(const std::string& value) const {
        const auto found = std::find(values.begin(), values.end(), value);
        return found == values.end() ? 0 : numbers[static_cast<std::size_t>(found - values.begin())];
    }
};

Abscissa abscissa_of(const SweepOptions& options) {
    Abscissa x;
    if (options.variations.empty()) {
        x.label = "method";
        for (Method method : options.methods)
            x.values.emplace_back(short_name(method));
    } else {
        const Variation& first = options.variations.front();
        x.label = first.setting->label;
        x.values = first.values;
        x.numbers = numbers_of(first);
    }
    if (!x.numbers.empty()) {
        const auto [least, most] = std::minmax_element(x.numbers.begin(), x.numbers.end());
        const bool is_wide = *most > 20 * *least; // such as 0, 0.01, 0.1, 1: then zero has no place on any scale
        x.scale = is_wide && *least > 0 ? ChartAxis::Scale::log : ChartAxis::Scale::linear;
        x.has_names = is_wide && *least <= 0;
    }
    if (x.has_names) {
        x.numbers.clear();
        for (std::size_t i = 0; i < x.values.size(); ++i)
            x.numbers.push_back(static_cast<double>(i));
    }
    return x;
}

ChartSeries& series_named(std::vector<ChartSeries>& all, const std::string& label) {
    const auto has_label = [&](const ChartSeries& s) { return s.label == label; };
    const auto found = std::find_if(all.begin(), all.end(), has_label);
    if (found != all.end())
        return *found;
    return all.emplace_back(ChartSeries{label, {}, false});
}

template <typename Point>
ChartPlot plot_of(const SweepOptions& options, const std::vector<SweepResult>& results, const std::string& y_label,
                  Point point) {
    const Abscissa x = abscissa_of(options);
    ChartPlot plot{x.label, y_label, x.scale, ChartAxis::Scale::log, {}, {}};
    if (x.has_names)
        plot.x_names = x.values;
    for (const SweepResult& result : results) {
        const std::string value = options.variations.empty()
                                      ? std::string(short_name(result.point.settings.method))
                                      : result.point.values.front();
        ChartSeries& series = series_named(plot.series, line_label(options, result));
        series.is_level = value.empty();
        series.points.push_back(point(x.at(value), result));
    }
    return plot;
}

} // namespace

std::string line_label(const SweepOptions& options, const SweepResult& result) {
    std::string label(short_name(result.point.settings.method));
    for (std::size_t i = 1; i < options.variations.size(); ++i)
        if (!result.point.values[i].empty())
            label += fmt::format(", {} {}", options.variations[i].setting->id, result.point.values[i]);
    return label;
}

Chart sweep_chart(const SweepOptions& options, const std::vector<SweepResult>& results) {
    const char* const bars = options.seeds > 1 ? "deviation of seeds" : "standard error";
    const auto error = [&](double x, const SweepResult& r) {
        return ChartPoint{x, error_of(r), options.seeds > 1 ? error_deviation(r) : error_standard_error(r)};
    };
    const auto efficiency = [](double x, const SweepResult& r) { return ChartPoint{x, efficiency_of(r), 0}; };
    return {title(options, results.front().scene),
            {plot_of(options, results, fmt::format("relMSE, floor-free (bars: {})", bars), error),
             plot_of(options, results, "efficiency, 1 / (relMSE × CPU seconds)", efficiency)}};
}

} // namespace tessera
