#pragma once

#include "app/sweep_points.h"
#include "recon/metrics.h"
#include "render/path/counters.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// One render of a point and its errors. Times are of rendering alone.
struct SweepRun {
    std::uint64_t seed = 0;
    int spp = 0;
    double cpu_seconds = 0, wall_seconds = 0;
    double relative_mse = 0; ///< to the mean of the references
    FloorFreeError floor_free;
    Counters counters;
};

/// What is known of one point on one scene.
struct SweepResult {
    std::string scene; ///< its name
    std::filesystem::path file;
    SweepPoint point;
    std::vector<SweepRun> runs; ///< one a seed
};

/// A figure of a result with at least one run; not a number where there is none.
struct SweepFigure {
    std::string_view id; ///< column of sweep.csv, field of sweep.json
    double (*value)(const SweepResult&);
};

/// All figures, in the order of the columns.
std::span<const SweepFigure> sweep_figures();

// Means over the runs, and their standard deviations, which take two runs.
double error_of(const SweepResult& result); ///< relMSE without the references' noise
double error_deviation(const SweepResult& result);
/// Of one run's error, from how the picture's blocks differ.
double error_standard_error(const SweepResult& result);
double cpu_seconds_of(const SweepResult& result);
double cpu_seconds_deviation(const SweepResult& result);
/// 1 / (error x CPU seconds) [Bauszat 2017]; not a number where the error is not above its noise.
double efficiency_of(const SweepResult& result);

// Shares of the base paths of all sampling sets, in [0, 1].
double reused_share(const SweepResult& result);
double skipped_share(const SweepResult& result); ///< by the reuse roulette
double dark_share(const SweepResult& result);    ///< they carry nothing to reuse

} // namespace tessera
