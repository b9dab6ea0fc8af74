#include "app/sweep_result.h"

#include <cmath>
#include <limits>

namespace tessera {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double count(const SweepResult& result) {
    return static_cast<double>(result.runs.size());
}

template <typename Value>
double mean(const SweepResult& result, Value value) {
    double sum = 0;
    for (const SweepRun& run : result.runs)
        sum += value(run);
    return sum / count(result);
}

template <typename Value>
double deviation(const SweepResult& result, Value value) {
    if (result.runs.size() < 2)
        return none;
    const double middle = mean(result, value);
    const double square = mean(result, [&](const SweepRun& run) { return std::pow(value(run) - middle, 2); });
    return std::sqrt(square * count(result) / (count(result) - 1));
}

double error(const SweepRun& run) {
    return run.floor_free.relative_mse;
}
double cpu_seconds(const SweepRun& run) {
    return run.cpu_seconds;
}

Counters total(const SweepResult& result) {
    Counters sum;
    for (const SweepRun& run : result.runs)
        sum += run.counters;
    return sum;
}

double share(std::uint64_t part, std::uint64_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : none;
}

const SweepFigure figures[] = {
    {"spp", [](const SweepResult& r) { return mean(r, [](const SweepRun& run) { return run.spp; }); }},
    {"seeds", count},
    {"cpu_seconds", cpu_seconds_of},
    {"cpu_seconds_deviation", cpu_seconds_deviation},
    {"wall_seconds",
     [](const SweepResult& r) { return mean(r, [](const SweepRun& run) { return run.wall_seconds; }); }},
    {"relmse", [](const SweepResult& r) { return mean(r, [](const SweepRun& run) { return run.relative_mse; }); }},
    {"relmse_floor_free", error_of},
    {"relmse_floor_free_standard_error", error_standard_error},
    {"relmse_floor_free_deviation", error_deviation},
    {"efficiency", efficiency_of},
    {"reused_share", reused_share},
    {"skipped_share", skipped_share},
    {"dark_share", dark_share},
    {"shift_attempts",
     [](const SweepResult& r) { return static_cast<double>(total(r).shift_attempts()) / count(r); }},
    {"shift_success_share",
     [](const SweepResult& r) {
         const Counters sum = total(r);
         return share(sum.shifts[static_cast<std::size_t>(ShiftOutcome::ok)], sum.shift_attempts());
     }},
    {"mean_path_vertices",
     [](const SweepResult& r) { return share(total(r).path_vertices, total(r).camera_paths); }},
    {"rays", [](const SweepResult& r) { return static_cast<double>(total(r).all_rays()) / count(r); }},
};

} // namespace

std::span<const SweepFigure> sweep_figures() {
    return figures;
}

double error_of(const SweepResult& r) {
    return mean(r, error);
}
double error_deviation(const SweepResult& r) {
    return deviation(r, error);
}
double error_standard_error(const SweepResult& r) {
    return mean(r, [](const SweepRun& run) { return run.floor_free.standard_error; });
}
double cpu_seconds_of(const SweepResult& r) {
    return mean(r, cpu_seconds);
}
double cpu_seconds_deviation(const SweepResult& r) {
    return deviation(r, cpu_seconds);
}

double efficiency_of(const SweepResult& r) {
    const double cost = error_of(r) * cpu_seconds_of(r);
    return cost > 0 ? 1 / cost : none;
}

double reused_share(const SweepResult& r) {
    return share(total(r).reused_paths, total(r).set_paths());
}
double skipped_share(const SweepResult& r) {
    return share(total(r).skipped_paths, total(r).set_paths());
}
double dark_share(const SweepResult& r) {
    return share(total(r).dark_paths, total(r).set_paths());
}

} // namespace tessera
