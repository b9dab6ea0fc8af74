#pragma once

#include "app/experiment/measurement.h"
#include "app/experiment/point.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// What is finished of a long job, in a file of one line for each piece: whatever ends the program, what was
/// recorded is there the next time. A last line that was torn, and lines that are not the journal's, do not count.
class Journal {
public:
    /// Reads the file, or begins one. Throws std::runtime_error that names it where it cannot be written.
    explicit Journal(std::filesystem::path file);

    /// What was last recorded under this key, which says all that it depends on; null: nothing was.
    nlohmann::json find(const nlohmann::json& key) const;
    /// Is on the disk when this returns. Throws std::runtime_error that names the file.
    void record(const nlohmann::json& key, const nlohmann::json& value);

private:
    std::filesystem::path file_;
    std::unordered_map<std::string, std::string> entries_; // values by their keys, both as text
};

/// What is known of one point on one scene after one share of its time or samples.
struct Result {
    std::string scene; ///< its name
    std::filesystem::path file;
    Point point;
    int halvings = 0;
    std::size_t triangles = 0;     ///< of the scene
    std::vector<Measurement> runs; ///< one a seed
};

/// What is found of each run, in their order.
template <class Value>
std::vector<double> of_runs(const Result& result, Value value) {
    std::vector<double> values;
    for (const Measurement& run : result.runs)
        values.push_back(value(run));
    return values;
}

/// A figure of a result with at least one run; not a number where there is none.
struct ResultFigure {
    std::string_view id; ///< column of a CSV file, field of a JSON file
    double (*value)(const Result&);
};

/// All figures, in the order of the columns.
std::span<const ResultFigure> all_figures();
/// The value of the figure of that id, which must be one of them.
double figure(std::string_view id, const Result& result);

// Means over the runs, and their standard deviations, which take two runs.
double error_of(const Result& result); ///< relMSE without the references' noise
double error_deviation(const Result& result);
/// Of the error: what is larger, one run's standard error, from how the picture's blocks differ (the references'
/// noise is the same for all seeds), or that of the mean over the seeds.
double error_uncertainty(const Result& result);
/// Whether the error is above its uncertainty, and so can be told from nothing.
bool is_certain(const Result& result);
double spp_of(const Result& result);
double cpu_seconds_of(const Result& result);
double cpu_seconds_deviation(const Result& result);
double wall_seconds_of(const Result& result);
/// 1 / (error x CPU seconds) [Bauszat 2017]; not a number where the error is not certain.
double efficiency_of(const Result& result);
/// Millions of samples of pixels a wall second.
double speed_of(const Result& result);

// Shares of the base paths of all sampling sets, in [0, 1].
double reused_share(const Result& result);
double skipped_share(const Result& result); ///< by the reuse roulette
double dark_share(const Result& result);    ///< they carry nothing to reuse

} // namespace tessera
