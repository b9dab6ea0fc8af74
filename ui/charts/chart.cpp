#include "ui/charts/chart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>

#include <fmt/core.h>

namespace tessera {

std::string escaped(std::string_view text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += static_cast<unsigned char>(c) < ' ' ? ' ' : c; // XML has no control characters
    }
    return out;
}

namespace {

constexpr int min_labels = 3, max_labels = 8;

std::string superscript(int number) {
    static constexpr std::string_view digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (char c : std::to_string(number))
        text += c == '-' ? std::string_view("⁻") : digits[c - '0'];
    return text;
}

/// Returns the smallest of 1, 2 and 5 times a power of ten that is at least `step`.
double round_up_to_125(double step) {
    const double power = std::pow(10, std::floor(std::log10(step)));
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * power >= step * (1 - 1e-9))
            return factor * power;
    return 10 * power;
}

std::vector<ChartTick> linear_ticks(double low, double high) {
    const double step = round_up_to_125((high - low) / max_labels);
    std::vector<ChartTick> ticks;
    for (double i = std::ceil(low / step); i * step <= high; ++i)
        ticks.push_back({i * step, chart_number(i * step)});
    return ticks;
}

/// Returns ticks at 1 to 9 times each decade; if `stride` is above 1, at the decades only. Labels the digits in
/// `labelled`, in every `stride`th decade.
std::vector<ChartTick> log_ticks(double low, double high, std::string_view labelled, int stride) {
    std::vector<ChartTick> ticks;
    const int first = static_cast<int>(std::floor(std::log10(low)));
    for (int decade = first; std::pow(10, decade) <= high; ++decade) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10, decade);
            const bool named = labelled.find(static_cast<char>('0' + digit)) != labelled.npos;
            if (value >= low && value <= high && (stride == 1 || digit == 1))
                ticks.push_back({value, named && decade % stride == 0 ? chart_number(value) : ""});
        }
    }
    return ticks;
}

std::ptrdiff_t label_count(const std::vector<ChartTick>& ticks) {
    return std::count_if(ticks.begin(), ticks.end(), [](const ChartTick& tick) { return !tick.label.empty(); });
}

/// Labels as few digits as needed for min_labels labels. A scale that is too short for this gets linear ticks.
std::vector<ChartTick> log_ticks(double low, double high) {
    const int stride = std::max(1, static_cast<int>(std::ceil(std::log10(high / low) / max_labels)));
    for (std::string_view digits : {"1", "125", "12357"}) {
        std::vector<ChartTick> ticks = log_ticks(low, high, digits, stride);
        if (label_count(ticks) >= min_labels)
            return ticks;
    }
    return linear_ticks(low, high);
}

} // namespace

std::string chart_number(double value) {
    const double size = std::abs(value);
    if (size == 0)
        return "0"; // also for -0
    if (size >= 0.9999e-4 && size < 0.99995e4)
        return fmt::format("{:.4g}", value);
    if (size >= 0.99995e4 && size < 0.99995e5)
        return fmt::format("{:.0f}", std::round(value / 10) * 10);
    const std::string text = fmt::format("{:.3e}", value); // such as -3.000e-05
    const std::size_t e = text.find('e');
    const double mantissa = std::stod(text.substr(0, e));
    const std::string power = "10" + superscript(std::stoi(text.substr(e + 1)));
    return mantissa == 1 ? power : fmt::format("{:g}·{}", mantissa, power);
}

ChartAxis ChartAxis::spanning(Scale scale, const std::vector<double>& values) {
    ChartAxis axis(scale, 1, 10);
    std::vector<double> valid;
    std::copy_if(values.begin(), values.end(), std::back_inserter(valid), [&](double v) { return axis.has(v); });
    if (!valid.empty()) {
        const auto [least, most] = std::minmax_element(valid.begin(), valid.end());
        const double low = *least, high = *most;
        const bool has_extent = high - low > 1e-9 * std::max(std::abs(low), std::abs(high));
        if (scale == Scale::log) {
            const double margin = has_extent ? std::pow(high / low, 0.06) : 2;
            axis.low_ = low / margin;
            axis.high_ = high * margin;
        } else {
            const double margin = has_extent ? 0.06 * (high - low) : std::max(1.0, 0.5 * std::abs(low));
            axis.low_ = low - margin;
            axis.high_ = high + margin;
        }
    }
    axis.ticks_ = scale == Scale::log ? log_ticks(axis.low_, axis.high_) : linear_ticks(axis.low_, axis.high_);
    return axis;
}

ChartAxis ChartAxis::of_names(const std::vector<std::string>& names) {
    ChartAxis axis(Scale::linear, -0.5, static_cast<double>(names.size()) - 0.5);
    for (std::size_t i = 0; i < names.size(); ++i)
        axis.ticks_.push_back({static_cast<double>(i), names[i]});
    return axis;
}

bool ChartAxis::has(double value) const {
    return std::isfinite(value) && (scale_ == Scale::linear || value > 0);
}

double ChartAxis::position(double value) const {
    return scale_ == Scale::log ? std::log(value / low_) / std::log(high_ / low_)
                                : (value - low_) / (high_ - low_);
}

ChartAxes axes_of(const ChartPlot& plot) {
    std::vector<double> xs, ys;
    for (const ChartSeries& series : plot.series) {
        for (const ChartPoint& p : series.points) {
            if (!series.is_level)
                xs.push_back(p.x);
            ys.push_back(p.y);
            ys.push_back(p.y + p.error);
            // On a log scale, an error bar extends the axis down to half of its value at most.
            ys.push_back(plot.y_scale == ChartAxis::Scale::log ? std::max(p.y - p.error, p.y / 2) : p.y - p.error);
        }
    }
    return {plot.x_names.empty() ? ChartAxis::spanning(plot.x_scale, xs) : ChartAxis::of_names(plot.x_names),
            ChartAxis::spanning(plot.y_scale, ys)};
}

} // namespace tessera
