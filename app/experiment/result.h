// What an experiment knows: what is finished, and the results of its setups with what is worked out
// from them.
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

/// What is finished of an experiment, by keys that say all that it depends on, in files of one line for each
/// piece. Lines that are torn, or not the journal's, do not count.
class Journal {
public:
    /// A line of such a file.
    static std::string line(const nlohmann::json& key, const nlohmann::json& value);

    /// Adds what the file holds; what it has of a key comes in place of what was known. Throws std::runtime_error
    /// that names the file where it cannot be read.
    void read(const std::filesystem::path& file);
    /// What was last read under this key; null: nothing was.
    nlohmann::json find(const nlohmann::json& key) const;
    /// The file that this is from; empty: nothing was read under this key.
    std::filesystem::path file_of(const nlohmann::json& key) const;
    /// Calls it with each key and what was last read under it.
    void for_each(const std::function<void(const nlohmann::json& key, const nlohmann::json& value)>& take) const;

private:
    struct Entry {
        std::string value; // as text
        std::size_t file;  // of files_
    };
    std::vector<std::filesystem::path> files_;       // that were read
    std::unordered_map<std::string, Entry> entries_; // by their keys, as text
};

/// What is known of one setup on one scene after one share of its time or samples.
struct Result {
    std::string scene; ///< its name
    std::filesystem::path file;
    Setup setup;
    int halvings = 0;
    std::size_t triangles = 0; ///< of the scene
    /// The kind of machine that all runs are of; empty: the results are not told apart by it.
    std::string machine = {};
    std::vector<Measurement> runs = {}; ///< one a seed, in their order

    /// What its scene is called in tables and charts: its name, and the machine where results are told apart by
    /// it.
    std::string title() const { return machine.empty() ? scene : scene + " (" + machine + ")"; }
};

/// What one run has found.
struct Record {
    std::size_t scene, setup; ///< by their places
    std::size_t triangles;
    Measurement measurement;
};

/// A scene by its name, and where that is known its file.
struct NamedScene {
    std::string name;
    std::filesystem::path file;
};

/// The records put together, by scene, setup, time or samples, and kind of machine where there are several and
/// they are to be told apart.
std::vector<Result> results_of(const std::vector<Record>& records, const std::vector<NamedScene>& scenes,
                               const std::vector<Setup>& setups, bool takes_any_machine);

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
