// Data of an experiment: the journal of finished runs, and results with the statistics derived from them.
#pragma once

#include "app/experiment/measured_run.h"
#include "app/experiment/setup.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// Finished runs by key, read from files with one JSON object per line. A key holds all inputs of a run.
/// Incomplete lines and lines of another form are ignored.
class Journal {
public:
    /// Returns a line of such a file.
    static std::string line(const nlohmann::json& key, const nlohmann::json& value);

    /// Adds the lines of a file; they replace earlier values of the same keys. Throws std::runtime_error that
    /// names the file if it cannot be read.
    void read(const std::filesystem::path& file);
    /// Returns the last value read for this key; null: none.
    nlohmann::json find(const nlohmann::json& key) const;
    /// Returns the file of that value; empty: none.
    std::filesystem::path file_of(const nlohmann::json& key) const;
    /// Calls `take` for each key with its last value.
    void for_each(const std::function<void(const nlohmann::json& key, const nlohmann::json& value)>& take) const;

private:
    struct Entry {
        std::string value; // JSON text
        std::size_t file;  // index into files_
    };
    std::vector<std::filesystem::path> files_;       // all files read
    std::unordered_map<std::string, Entry> entries_; // by the key's JSON text
};

/// Measurements of one setup on one scene at one effort.
struct Result {
    std::string scene; ///< name of the scene
    std::filesystem::path file;
    Setup setup;
    int halvings = 0;
    std::size_t triangles = 0; ///< in the scene
    /// Kind of machine of all runs; empty: results are not separated by machine.
    std::string machine = {};
    std::vector<Measurement> runs = {}; ///< one for each seed, in order of seeds

    /// Returns the label of tables and charts: the scene's name, with the machine if results are separated by it.
    std::string title() const { return machine.empty() ? scene : scene + " (" + machine + ")"; }
};

/// Measurement of one run.
struct Record {
    std::size_t scene, setup; ///< indices
    std::size_t triangles;
    Measurement measurement;
};

/// A scene's name and its file; an empty file: not known.
struct NamedScene {
    std::string name;
    std::filesystem::path file;
};

/// Groups records into results, ordered by scene, kind of machine, setup and increasing effort. Results of
/// several kinds of machines are separate unless `takes_any_machine`.
std::vector<Result> results_of(const std::vector<Record>& records, const std::vector<NamedScene>& scenes,
                               const std::vector<Setup>& setups, bool takes_any_machine);

/// Returns a value of each run, in order of the runs.
template <class Value>
std::vector<double> of_runs(const Result& result, Value value) {
    std::vector<double> values;
    for (const Measurement& run : result.runs)
        values.push_back(value(run));
    return values;
}

/// A column of the tables of results, in CSV files and in JSON.
struct ResultColumn {
    std::string_view id;
    double (*value)(const Result&); ///< requires at least one run; NaN: no value
};

/// Returns all columns in order.
std::span<const ResultColumn> result_columns();
/// Returns a result's value in the column of that id, which must exist.
double column_value(std::string_view id, const Result& result);

// Means over the runs, and standard deviations, which need two runs.
double error_of(const Result& result); ///< relMSE without the noise of the references
double error_deviation(const Result& result);
/// Returns the larger of two standard errors of error_of: the mean standard error of a run, from the differences
/// between pieces of its picture, and the standard error of the mean over seeds. The first includes the
/// references' noise, which is the same for all seeds.
double error_uncertainty(const Result& result);
/// Returns whether the error is larger than its uncertainty.
bool is_significant(const Result& result);
double spp_of(const Result& result);
double cpu_seconds_of(const Result& result);
double cpu_seconds_deviation(const Result& result);
double wall_seconds_of(const Result& result);
/// Returns 1 / (error x CPU seconds) [Bauszat 2017]; NaN if the error is not significant.
double efficiency_of(const Result& result);
/// Returns 10^6 pixel samples per wall second.
double speed_of(const Result& result);

// Fractions of the base paths of all sampling sets, in [0, 1].
double reused_fraction(const Result& result);
double skipped_fraction(const Result& result); ///< skipped by Russian roulette on reuse
double dark_fraction(const Result& result);    ///< with no light to reuse

} // namespace tessera
