#include "app/experiment/speed_up.h"

#include "recon/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Returns the continued fraction of I_x(a, b) for x < (a + 1) / (a + b + 2) [Abramowitz and Stegun 1964,
/// 26.5.8], evaluated forwards [Lentz 1976].
double beta_fraction(double x, double a, double b) {
    constexpr double tiny = 1e-300;
    double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), fraction = d;
    const auto step = [&](double term) {
        d = 1 / (1 + term * d);
        c = 1 + term / c;
        if (std::abs(c) < tiny)
            c = tiny;
        fraction *= c * d;
    };
    for (int m = 1; m < 500; ++m) {
        const double before = fraction;
        step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
        step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)));
        if (std::abs(fraction - before) < 1e-14 * std::abs(fraction))
            break;
    }
    return fraction;
}

/// Returns the regularised incomplete beta function I_x(a, b).
double incomplete_beta(double x, double a, double b) {
    if (x <= 0 || x >= 1)
        return x <= 0 ? 0 : 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1) / (a + b + 2) ? front * beta_fraction(x, a, b) / a
                                     : 1 - front * beta_fraction(1 - x, b, a) / b;
}

/// Returns the argument in [0, high] at which a decreasing function has the value, by bisection.
template <class Function>
double inverse(Function function, double value, double high) {
    double low = 0;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (function(middle) > value ? low : high) = middle;
    }
    return (low + high) / 2;
}

double count_of(const std::vector<double>& values) {
    return static_cast<double>(values.size());
}

} // namespace

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum / count_of(values);
}

double deviation_of(const std::vector<double>& values) {
    if (values.size() < 2)
        return std::numeric_limits<double>::quiet_NaN();
    const double mean = mean_of(values);
    double squares = 0;
    for (double v : values)
        squares += (v - mean) * (v - mean);
    return std::sqrt(squares / (count_of(values) - 1));
}

double standard_error_of(const std::vector<double>& values) {
    return deviation_of(values) / std::sqrt(count_of(values));
}

double jackknife_error(const std::vector<double>& found) {
    return standard_error_of(found) * (count_of(found) - 1);
}

double student_tail(double t, double freedom) {
    return incomplete_beta(freedom / (freedom + t * t), freedom / 2, 0.5); // [Abramowitz and Stegun 1964, 26.7.1]
}

double student_t(double probability, double freedom) {
    return inverse([&](double t) { return student_tail(t, freedom); }, probability, 1e9);
}

double sigmas(double probability) {
    return inverse([](double z) { return std::erfc(z / std::sqrt(2.0)); }, probability, 37);
}

/// Removes the points that only some of the seeds have reached (the others' first pass took longer): their means
/// are over other seeds than those of the later points.
static void drop_partial(Curve& curve) {
    std::size_t max_runs = 0;
    for (const Result& result : curve)
        max_runs = std::max(max_runs, result.runs.size());
    std::erase_if(curve, [&](const Result& result) { return result.runs.size() < max_runs; });
}

std::vector<SceneCurves> curves_by_scene(const std::vector<Result>& results) {
    std::vector<SceneCurves> scenes;
    const auto goes_on = [](const std::vector<Curve>& curves, const Setup& setup) {
        return !curves.empty() && name_of(last_of(curves.back()).setup) == name_of(setup) &&
               last_of(curves.back()).setup.values == setup.values;
    };
    for (const Result& result : results) {
        if (scenes.empty() || scenes.back().name != result.title())
            scenes.push_back({result.title(), {}});
        std::vector<Curve>& curves = scenes.back().curves;
        if (!goes_on(curves, result.setup))
            curves.emplace_back();
        curves.back().push_back(result);
    }
    for (SceneCurves& scene : scenes)
        for (Curve& curve : scene.curves)
            drop_partial(curve);
    return scenes;
}

double slope_of(const Curve& curve) {
    std::vector<glm::dvec2> points;
    for (const Result& result : curve)
        if (is_significant(result))
            points.emplace_back(cpu_seconds_of(result), error_of(result));
    return log_log_slope(points).value;
}

const Curve* best_curve(const SceneCurves& scene, Method method) {
    const Curve* best = nullptr;
    for (const Curve& curve : scene.curves)
        if (last_of(curve).setup.settings.render.method == method &&
            (!best || error_of(last_of(curve)) < error_of(last_of(*best))))
            best = &curve;
    return best;
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct LogPoint {
    double log_time, log_error;
};

/// Replaces the curve by its least-squares non-increasing fit: points where the error rises, which happens for
/// few seeds, get their mean (pool adjacent violators [Ayer 1955]).
void make_monotone(std::vector<LogPoint>& points) {
    struct Pool {
        double sum;
        std::size_t count;
        double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Pool> pools;
    for (const LogPoint& point : points) {
        pools.push_back({point.log_error, 1});
        for (std::size_t n; (n = pools.size()) > 1 && pools[n - 1].mean() > pools[n - 2].mean();
             pools.pop_back()) {
            pools[n - 2].sum += pools[n - 1].sum;
            pools[n - 2].count += pools[n - 1].count;
        }
    }
    auto point = points.begin();
    for (const Pool& pool : pools)
        for (std::size_t i = 0; i < pool.count; ++i)
            (point++)->log_error = pool.mean();
}

/// Returns the significant results in order of time, in log-log coordinates.
std::vector<LogPoint> log_points_of(const Curve& curve) {
    std::vector<LogPoint> points;
    for (const Result& result : curve)
        if (!result.runs.empty() && is_significant(result))
            points.push_back({std::log(cpu_seconds_of(result)), std::log(error_of(result))});
    make_monotone(points);
    return points;
}

double least_error(const std::vector<LogPoint>& points) {
    return std::min_element(points.begin(), points.end(),
                            [](const LogPoint& a, const LogPoint& b) { return a.log_error < b.log_error; })
        ->log_error;
}

/// Returns the log time at which the error last crosses the value while falling; empty: it is below from the
/// start.
std::optional<double> time_of(const std::vector<LogPoint>& points, double log_error) {
    for (std::size_t i = points.size(); i-- > 1;) {
        const LogPoint &before = points[i - 1], &after = points[i];
        if (before.log_error >= log_error && log_error >= after.log_error) {
            const double fall = before.log_error - after.log_error;
            const double fraction = fall > 0 ? (before.log_error - log_error) / fall : 1;
            return before.log_time + fraction * (after.log_time - before.log_time);
        }
    }
    const bool is_first = points.front().log_error <= log_error && points.size() == 1;
    return is_first ? std::optional(points.front().log_time) : std::nullopt;
}

/// Returns the speed-up without its confidence interval.
SpeedUp estimate(const Curve& slower, const Curve& faster) {
    const std::vector<LogPoint> slow = log_points_of(slower), fast = log_points_of(faster);
    if (slow.empty() || fast.empty())
        return {SpeedUp::Kind::none, none, none, none, none};
    const double log_error = std::max(least_error(slow), least_error(fast));
    const std::optional<double> slow_time = time_of(slow, log_error), fast_time = time_of(fast, log_error);
    const SpeedUp::Kind kind = !fast_time   ? SpeedUp::Kind::at_least
                               : !slow_time ? SpeedUp::Kind::at_most
                                            : SpeedUp::Kind::measured;
    const double ratio = slow_time.value_or(slow.front().log_time) - fast_time.value_or(fast.front().log_time);
    return {kind, std::exp(ratio), none, none, std::exp(log_error)};
}

Curve without(const Curve& curve, std::uint64_t seed) {
    Curve rest = curve;
    for (Result& result : rest)
        std::erase_if(result.runs, [&](const Measurement& m) { return m.seed == seed; });
    return rest;
}

std::set<std::uint64_t> seeds_of(const Curve& curve) {
    std::set<std::uint64_t> seeds;
    for (const Result& result : curve)
        for (const Measurement& m : result.runs)
            seeds.insert(m.seed);
    return seeds;
}

} // namespace

SpeedUp speed_up(const Curve& slower, const Curve& faster) {
    SpeedUp result = estimate(slower, faster);
    if (result.kind != SpeedUp::Kind::measured)
        return result;
    std::set<std::uint64_t> seeds = seeds_of(slower);
    seeds.merge(seeds_of(faster));
    const auto n = static_cast<double>(seeds.size());
    std::vector<double> logs;
    for (std::uint64_t seed : seeds)
        if (const SpeedUp one = estimate(without(slower, seed), without(faster, seed));
            one.kind != SpeedUp::Kind::none)
            logs.push_back(std::log(one.factor));
    if (logs.size() < 2 || logs.size() < seeds.size())
        return result;
    const double half_width = student_t(0.05, n - 1) * jackknife_error(logs);
    result.low = result.factor * std::exp(-half_width);
    result.high = result.factor * std::exp(half_width);
    return result;
}

std::string to_string(const SpeedUp& s) {
    switch (s.kind) {
    case SpeedUp::Kind::none:
        return "out of range";
    case SpeedUp::Kind::at_least:
        return fmt::format("at least {:.3g}", s.factor);
    case SpeedUp::Kind::at_most:
        return fmt::format("at most {:.3g}", s.factor);
    case SpeedUp::Kind::measured:
        break;
    }
    return std::isfinite(s.low) ? fmt::format("{:.3g} ({:.3g} to {:.3g})", s.factor, s.low, s.high)
                                : fmt::format("{:.3g}", s.factor);
}

} // namespace tessera
