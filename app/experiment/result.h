// What an experiment knows: the journal of what is finished, and the results of its setups with what is worked out
// from them.
#pragma once

#include "app/experiment/measured_run.h"
#include "app/experiment/setup.h"

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
    /// Records a value, which is on the disk when this returns. Throws std::runtime_error that names the file.
    void record(const nlohmann::json& key, const nlohmann::json& value);

private:
    std::filesystem::path file_;
    std::unordered_map<std::string, std::string> entries_; // values by their keys, both as text
};

/// What is known of one setup on one scene after one share of its time or samples.
struct Result {
    std::string scene; ///< its name
    std::filesystem::path file;
    Setup setup;
    int halvings = 0;
    std::size_t triangles = 0;     ///< of the scene
    std::vector<Measurement> runs; ///< one a seed
};

/// A value of each run, in their order.
template <class Value>
std::vector<double> of_runs(const Result& result, Value value) {
    std::vector<double> values;
    for (const Measurement& run : result.runs)
        values.push_back(value(run));
    return values;
}

/// A column of tables of results: a CSV file's, and a field of a JSON file.
struct ResultColumn {
    std::string_view id;
    double (*value)(const Result&); ///< of a result with at least one run; not a number where there is none
};

/// All columns, in their order.
std::span<const ResultColumn> result_columns();
/// The value in the column of that id, which must be one of them.
double column_value(std::string_view id, const Result& result);

// These are means over the runs, and their standard deviations, which take two runs.
double error_of(const Result& result); ///< relMSE without the references' noise
double error_deviation(const Result& result);
/// The uncertainty of the error, which is the larger of two standard errors: one run's, from how the picture's
/// pieces differ (the references' noise is the same for all seeds), and that of the mean over the seeds.
double error_uncertainty(const Result& result);
/// Whether the error is above its uncertainty, and so can be told from nothing.
bool is_certain(const Result& result);
double spp_of(const Result& result);
double cpu_seconds_of(const Result& result);
double cpu_seconds_deviation(const Result& result);
double wall_seconds_of(const Result& result);
/// The efficiency 1 / (error x CPU seconds) [Bauszat 2017]; not a number where the error is not certain.
double efficiency_of(const Result& result);
/// The speed in millions of samples of pixels a wall second.
double speed_of(const Result& result);

// These are shares of the base paths of all sampling sets, in [0, 1].
double reused_share(const Result& result);
double skipped_share(const Result& result); ///< by the reuse roulette
double dark_share(const Result& result);    ///< they carry nothing to reuse

} // namespace tessera
