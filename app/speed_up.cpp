#include "app/speed_up.h"

#include "app/significance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Place {
    double log_time, log_error;
};

/// The nearest curve that never rises: where one sample of a few seeds makes the error rise for a while, the
/// places about it get their mean (pool adjacent violators [Ayer 1955]).
void level(std::vector<Place>& places) {
    struct Pool {
        double sum;
        std::size_t count;
        double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Pool> pools;
    for (const Place& place : places) {
        pools.push_back({place.log_error, 1});
        for (std::size_t n; (n = pools.size()) > 1 && pools[n - 1].mean() > pools[n - 2].mean();
             pools.pop_back()) {
            pools[n - 2].sum += pools[n - 1].sum;
            pools[n - 2].count += pools[n - 1].count;
        }
    }
    auto place = places.begin();
    for (const Pool& pool : pools)
        for (std::size_t i = 0; i < pool.count; ++i)
            (place++)->log_error = pool.mean();
}

/// The certain results in the order of time, as on a log-log chart.
std::vector<Place> places_of(const Curve& curve) {
    std::vector<Place> places;
    for (const Result& result : curve)
        if (!result.runs.empty() && is_certain(result))
            places.push_back({std::log(cpu_seconds_of(result)), std::log(error_of(result))});
    level(places);
    return places;
}

double least_error(const std::vector<Place>& places) {
    return std::min_element(places.begin(), places.end(),
                            [](const Place& a, const Place& b) { return a.log_error < b.log_error; })
        ->log_error;
}

/// When the error was last passed on its way down; empty: it was below from the first.
std::optional<double> time_of(const std::vector<Place>& places, double log_error) {
    for (std::size_t i = places.size(); i-- > 1;) {
        const Place &before = places[i - 1], &after = places[i];
        if (before.log_error >= log_error && log_error >= after.log_error) {
            const double fall = before.log_error - after.log_error;
            const double share = fall > 0 ? (before.log_error - log_error) / fall : 1;
            return before.log_time + share * (after.log_time - before.log_time);
        }
    }
    const bool is_first = places.front().log_error <= log_error && places.size() == 1;
    return is_first ? std::optional(places.front().log_time) : std::nullopt;
}

/// Without confidence.
SpeedUp estimate(const Curve& slower, const Curve& faster) {
    const std::vector<Place> slow = places_of(slower), fast = places_of(faster);
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
    const double reach = student_t(0.05, n - 1) * jackknife_error(logs);
    result.low = result.factor * std::exp(-reach);
    result.high = result.factor * std::exp(reach);
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
