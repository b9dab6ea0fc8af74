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

/// What a command does of an experiment that processes share.
struct Sharing {
    enum class Task { work, list, one_job, report };
    Task task = Task::work;
    int job = 0;                          ///< which one, from 1 on
    double silence = 60;                  ///< seconds, as in Claims
    std::string machine = machine_kind(); ///< the kind of this machine, recorded with what it renders
    bool takes_any_machine = false;       ///< results of several kinds of machines are put together
};

/// What is rendered and measured: scenes, each with all setups, each with some seeds.
struct ExperimentOptions {
    std::string command; ///< "bench": which one they were given to
    std::vector<std::filesystem::path> scenes;
    SceneVariables variables; ///< of all scenes
    std::vector<Method> methods = {Method::gpr};
    std::vector<Norm> norms = {Norm::weighted};
    std::vector<Variation> variations;
    PictureSettings settings;         ///< of all setups, but for what is varied
    Effort effort;                    ///< what each render is given
    int halvings = 0;                 ///< errors are taken at effort / 2^i for i from `halvings` down to 0
    int seeds = 1;                    ///< renders of each setup, with the seeds settings.render.seed and following
    std::filesystem::path references; ///< folder of the references; what is missing there is made
    ReferenceRecipe recipe;
    std::filesystem::path output; ///< folder, made where there is none
    bool takes_any_build = false; ///< of what is finished: what other builds of the program have rendered, too
    bool measures_artefacts = false;
    bool keeps_images = false; ///< of the first seed, at the end: see Experiment::image_file
    Sharing sharing;
};

/// What a job's file says of a run beside checksums of scene and reference: what it is of.
nlohmann::json key_of_run(const ExperimentOptions& options, const std::string& scene, const Setup& setup,
                          std::uint64_t seed);

/// Renders that are compared with each other, in jobs that any number of processes share. What a job has found is
/// in a file of its own, OUTPUT/jobs/NAME.jsonl, and is never rendered again by the same program with the same
/// references.
class Experiment {
public:
    /// A scene and a seed, and setups that take turns pass by pass, so that a machine that others use as well is
    /// slow for all of them alike: all setups where they are given time, of which their errors depend; those of
    /// one point of the variations where they are given samples. Setups that differ in reconstruction alone share
    /// their render.
    struct Job {
        std::size_t scene;
        std::uint64_t seed;
        std::vector<std::size_t> setups; ///< by their indices
    };

    /// Looks at all that was given. Throws BadInput, or std::runtime_error for references that cannot be read.
    explicit Experiment(const ExperimentOptions& options);

    const ExperimentOptions& options() const { return options_; }
    const std::vector<MeasuredScene>& scenes() const { return scenes_; }
    std::vector<MeasuredScene>& scenes() { return scenes_; }
    const std::vector<Setup>& setups() const { return setups_; }
    /// By scene, seed and point.
    const std::vector<Job>& jobs() const { return jobs_; }

    /// The file that the job makes; empty: a reference is missing.
    std::filesystem::path file_of(std::size_t job);
    bool is_done(std::size_t job);
    /// The files of other lists of jobs that have all that the job is to find, so that it makes none; empty: it is
    /// to make its own.
    std::vector<std::filesystem::path> known_in(std::size_t job) const;
    /// Renders a job whose references are there, and makes its file. `tell` is told how much of it is done. Throws
    /// as open_scene and check_available do, and BadInput for references of another scene. False: Ctrl-C ended it.
    bool run(std::size_t job, Claim& claim, const std::function<void(double)>& tell);
    /// Renders a reference of the scene. Throws as run() does. False: Ctrl-C ended it.
    bool render_reference(std::size_t scene, FolderReference& reference);

    /// The results that have a run, by scene, setup, time or samples, and kind of machine where there are several.
    /// Throws std::runtime_error for a job's file that holds something else.
    std::vector<Result> results();
    /// CPU seconds (of renders by wall time: seconds) that the job may take, by what is known of the same point,
    /// or else scene; not a number: nothing is.
    double estimate(std::size_t job);
    /// "box, seed 3, tile 4": what a job renders.
    std::string text_of(const Job& job) const;
    /// Where the picture of a setup is kept that the first seed came to.
    std::filesystem::path image_file(const std::string& scene, const Setup& setup) const;

private:
    using Setups = std::vector<std::size_t>; // by their indices
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
    std::vector<std::uint32_t> scene_files_; ///< checksums of what the scenes' files say
    std::vector<Job> jobs_;
    std::vector<std::filesystem::path> files_;  ///< of the jobs; empty where it is not known yet
    std::vector<std::uint8_t> is_recalled_;     ///< 1: other files have all that the job is to find
    std::vector<std::uint8_t> is_collected_;    ///< 1: it is in records_
    std::map<Setups, std::string> point_names_; ///< by setups and scene
    Journal journal_;                           ///< what other lists of jobs have found
    std::vector<Record> records_;
    std::map<int, std::unique_ptr<ThreadPool>> pools_; ///< by their threads
    std::size_t open_scene_ = 0;                       ///< the one that geometry_ is of
    std::shared_ptr<const Scene> geometry_;            ///< null: none is loaded
};

/// The words of `tessera sweep`, `bench` and `stability`, before they are given a meaning.
struct ExperimentWords {
    std::vector<std::string> scenes, variations;
    std::string methods, norms, clock = "cpu";
    int spp = 0;
    bool lists = false, only_reports = false, is_quick = false;
    double time = 0;
    ExperimentOptions options; ///< all that is not above
};

// Each of these adds its command to `app`; `words` take what is given to it, and must live as long.
void add_sweep(CLI::App& app, ExperimentWords& words);
void add_bench(CLI::App& app, ExperimentWords& words);
void add_stability(CLI::App& app, ExperimentWords& words);

/// What the words mean that were given to one of these commands. Throws BadInput that names the option.
ExperimentOptions parse_experiment(const CLI::App& command, const ExperimentWords& words);

} // namespace tessera
