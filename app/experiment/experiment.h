#pragma once

#include "app/cli/terminal.h"
#include "app/experiment/claim.h"
#include "app/experiment/measured_run.h"
#include "app/experiment/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace tessera {

/// Options of a command for dividing an experiment among processes.
struct WorkDivision {
    enum class Task { work, list, one_job, report };
    Task task = Task::work;
    int job = 0;                          ///< number of the job for Task::one_job, from 1
    double silence = 60;                  ///< seconds, as in Claims
    std::string machine = machine_kind(); ///< kind of this machine, recorded with each measurement
    bool takes_any_machine = false;       ///< results of different kinds of machines are merged
};

/// Definition of an experiment: every scene is rendered with every setup and every seed.
struct ExperimentOptions {
    std::string command; ///< the command's name, such as "bench"
    std::vector<std::filesystem::path> scenes;
    SceneVariables variables; ///< the same for all scenes
    std::vector<Method> methods = {Method::gpr};
    std::vector<Norm> norms = {Norm::weighted};
    std::vector<Variation> variations;
    PictureSettings settings;         ///< defaults of all setups; variations override them
    Effort effort;                    ///< time or samples of each render
    int halvings = 0;                 ///< errors are measured at effort / 2^i for i from `halvings` down to 0
    int seeds = 1;                    ///< renders of each setup, with seeds from settings.render.seed on
    std::filesystem::path references; ///< folder of the references; missing ones are rendered
    ReferenceRecipe recipe;
    std::filesystem::path output; ///< folder; created if it does not exist
    bool takes_any_build = false; ///< accepts finished jobs from other builds of the program
    bool measures_artefacts = false;
    bool keeps_images = false; ///< keeps the final pictures of the first seed: see Experiment::image_file
    WorkDivision sharing;
};

/// Returns the key of a run in a job's file, except for the checksums of scene and reference.
nlohmann::json key_of_run(const ExperimentOptions& options, const std::string& scene, const Setup& setup,
                          std::uint64_t seed);

/// Renders that are compared with each other, as jobs that any number of processes can share. The results of a
/// job are in its own file, OUTPUT/jobs/NAME.jsonl. The same program with the same references never repeats a
/// finished job.
class Experiment {
public:
    /// Setups of one scene and one seed. They take turns pass by pass, so that other load on the machine slows
    /// all of them equally. With a time limit a job has all setups, since their errors depend on the speed. With
    /// a sample count, it has the setups with equal values of all varied settings. Setups that differ only in
    /// reconstruction share a render.
    struct Job {
        std::size_t scene;
        std::uint64_t seed;
        std::vector<std::size_t> setups; ///< indices into setups()
    };

    /// Validates the options. Throws BadInput, or std::runtime_error for references that cannot be read.
    explicit Experiment(const ExperimentOptions& options);

    const ExperimentOptions& options() const { return options_; }
    const std::vector<MeasuredScene>& scenes() const { return scenes_; }
    std::vector<MeasuredScene>& scenes() { return scenes_; }
    const std::vector<Setup>& setups() const { return setups_; }
    /// Jobs in order of scene, seed and point.
    const std::vector<Job>& jobs() const { return jobs_; }

    /// Returns the file that the job makes; empty: a reference is missing, so its checksum is unknown.
    std::filesystem::path file_of(std::size_t job);
    bool is_done(std::size_t job);
    /// Returns the files of other job lists that together contain all results of the job, which then makes no
    /// file of its own; empty: the job makes its own file.
    std::vector<std::filesystem::path> known_in(std::size_t job) const;
    /// Renders a job whose references exist, and makes its file. Calls `report_progress` with the finished
    /// fraction. Throws as open_scene and check_available do, and BadInput for references of another scene.
    /// Returns false if Ctrl-C interrupted it.
    bool run(std::size_t job, Claim& claim, const std::function<void(double)>& report_progress);
    /// Renders a reference of the scene. Throws as run() does. Returns false if Ctrl-C interrupted it.
    bool render_reference(std::size_t scene, FolderReference& reference);

    /// Returns all results with at least one run, ordered by scene, kind of machine if there are several, setup
    /// and effort. Throws std::runtime_error for a damaged job file.
    std::vector<Result> results();
    /// Estimates the CPU seconds of a job (seconds, for renders by wall time) from finished runs of the same
    /// setups, or else of the same scene; NaN: none is finished.
    double estimate(std::size_t job);
    /// Describes a job: "box, seed 3, tile 4".
    std::string text_of(const Job& job) const;
    /// Returns the file in which the first seed's picture of a setup is kept.
    std::filesystem::path image_file(const std::string& scene, const Setup& setup) const;

private:
    using Setups = std::vector<std::size_t>; // indices into setups_
    struct SharedRun;
    void list_jobs();
    void check_norms() const;
    std::string file_name_of(const Job& job);
    void recall();
    const std::shared_ptr<const Scene>& open(std::size_t scene);
    std::vector<SharedRun> runs_of(const Job& job, const std::shared_ptr<const Scene>& geometry);
    std::string finish(const Job& job, const SharedRun& shared);
    std::vector<Setups> renders_of(const Setups& setups) const;
    nlohmann::json find(const Journal& journal, const Job& job, std::size_t setup) const;
    nlohmann::json recalled(const Job& job, std::size_t setup) const;
    bool is_known(const Job& job) const;
    bool has_images(const Job& job) const;
    void collect(std::size_t job);
    bool keeps_image(std::uint64_t seed) const;
    nlohmann::json key_of(std::size_t scene, const Setup& setup, std::uint64_t seed) const;
    ThreadPool& pool(int threads);

    const ExperimentOptions& options_;
    std::vector<Setup> setups_;
    std::vector<MeasuredScene> scenes_;
    std::vector<std::uint32_t> scene_files_; ///< checksums of the scene files and their variables
    std::vector<Job> jobs_;
    std::vector<std::filesystem::path> files_;  ///< of the jobs; empty: not known yet
    std::vector<std::uint8_t> is_recalled_;     ///< 1: files of other job lists have all results of the job
    std::vector<std::uint8_t> is_collected_;    ///< 1: the job's results are in records_
    std::map<Setups, std::string> point_names_; ///< cached file names without seed, by setups and scene
    Journal journal_;                           ///< results in files of other job lists
    std::vector<Record> records_;
    std::map<int, std::unique_ptr<ThreadPool>> pools_; ///< by number of threads
    std::size_t open_scene_ = 0;                       ///< index of the scene in geometry_
    std::shared_ptr<const Scene> geometry_;            ///< the scene that is loaded; null: none
};

/// Command-line arguments of `tessera sweep`, `bench` and `stability`, before parse_experiment() reads them.
struct ExperimentArguments {
    std::vector<std::string> scenes, variations;
    std::string methods, norms, clock = "cpu";
    int spp = 0;
    bool lists = false, only_reports = false, is_quick = false;
    double time = 0;
    ExperimentOptions options; ///< all other options
};

// Each of these adds its subcommand to `app`, which stores its arguments in `words`; `words` must outlive `app`.
void add_sweep(CLI::App& app, ExperimentArguments& words);
void add_bench(CLI::App& app, ExperimentArguments& words);
void add_stability(CLI::App& app, ExperimentArguments& words);

/// Parses the arguments of one of these commands. Throws BadInput that names the option.
ExperimentOptions parse_experiment(const CLI::App& command, const ExperimentArguments& words);

} // namespace tessera
