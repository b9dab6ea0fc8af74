// The list of an experiment's jobs as a file in the output folder, for programs that follow the folder without
// knowing the command.
#pragma once

#include "app/experiment/experiment.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

struct JobPlan {
    /// One experiment.
    struct Work {
        ExperimentOptions options;       ///< what charts and results need; without scenes, folders and references
        std::vector<std::string> scenes; ///< names of the scenes
    };
    struct Job {
        std::size_t work = 0;
        std::string what; ///< description: "box, seed 3, tile 4"
        std::filesystem::path
            file; ///< the job's file, relative to the output folder; empty: a reference is missing
        bool is_reference = false;
        /// Files of other job lists that contain all results, as relative paths; empty: the job makes its own.
        std::vector<std::filesystem::path> known_in = {};
    };

    std::vector<Work> works;
    std::vector<Job> jobs; ///< in order: the references of a job come before it
};

/// Returns the plan's file in an experiment's output folder.
std::filesystem::path plan_file(const std::filesystem::path& folder);

/// Writes the plan unless the file already holds it. Throws std::runtime_error that names the file.
void write_plan(const std::filesystem::path& file, const JobPlan& plan);

/// Returns the first line of the plan's file, which has its checksum; empty: the file is missing or no plan.
std::string plan_mark(const std::filesystem::path& file);

/// Reads a plan. Throws std::runtime_error that names the file for malformed JSON, with line and column, and for
/// a plan of another version.
JobPlan read_plan(const std::filesystem::path& file);

} // namespace tessera
