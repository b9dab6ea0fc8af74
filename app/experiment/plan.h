// What a folder of jobs is to hold: written beside them, for those who look at the folder without being given the
// command.
#pragma once

#include "app/experiment/experiment.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

struct JobPlan {
    /// An experiment.
    struct Work {
        ExperimentOptions options; ///< what charts and results need of them: no scenes, folders or references
        std::vector<std::string> scenes; ///< their names
    };
    struct Job {
        std::size_t work = 0;
        std::string what;           ///< "box, seed 3, tile 4"
        std::filesystem::path file; ///< that it makes, from the folder on; empty: a reference is missing
        bool is_reference = false;
        /// Files of other lists that have all that it is to find, likewise; empty: it makes its own.
        std::vector<std::filesystem::path> known_in = {};
    };

    std::vector<Work> works;
    std::vector<Job> jobs; ///< in their order: what one needs stands before it
};

/// The plan's file in an experiment's folder.
std::filesystem::path plan_file(const std::filesystem::path& folder);

/// Writes it, unless it is there. Throws std::runtime_error that names the file.
void write_plan(const std::filesystem::path& file, const JobPlan& plan);

/// A line by which plans differ; empty: there is none, or it is none.
std::string plan_mark(const std::filesystem::path& file);

/// Throws std::runtime_error that names the file where it holds something else, as one by another version does;
/// where it is broken, with line and column.
JobPlan read_plan(const std::filesystem::path& file);

} // namespace tessera
