#pragma once

#include "app/cli/terminal.h"
#include "app/experiment/measured_run.h"
#include "app/experiment/result.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace tessera {

/// What is rendered and measured: scenes, each with all setups, each with some seeds.
struct ExperimentOptions {
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
    bool takes_any_build = false; ///< from the journal: what other builds of the program have recorded, too
    bool measures_artefacts = false;
    bool keeps_images = false; ///< of the first seed, at the end: see Experiment::image_file
};

/// Renders round by round: a round is a scene and a seed with all setups, which take turns pass by pass, so that a
/// machine that others use as well is slow for all of them alike. Setups that differ in reconstruction alone share
/// their render. What is finished is recorded in OUTPUT/journal.jsonl, and never rendered again by the same
/// program on the same machine with the same references.
class Experiment {
public:
    /// Looks at all that was given. Throws BadInput, or std::runtime_error for references that cannot be read.
    explicit Experiment(const ExperimentOptions& options);

    /// Calls `report` after every round, and at the end. Throws as open_scene does. Ends early, in good order,
    /// once there is an interrupt.
    void run(const std::function<void()>& report);

    const ExperimentOptions& options() const { return options_; }
    const std::vector<MeasuredScene>& scenes() const { return scenes_; }
    /// The results that have a run, by scene, setup, and time or samples.
    std::vector<Result> results() const;
    /// Where the picture of a setup is kept that the first seed came to.
    std::filesystem::path image_file(const std::string& scene, const Setup& setup) const;

private:
    struct SharedRun;

    void run_scene(MeasuredScene& scene, const std::function<void()>& report);
    void run_round(const MeasuredScene& scene, const std::shared_ptr<const Scene>& geometry, std::uint64_t seed);
    std::vector<SharedRun> unfinished_runs(const MeasuredScene& scene,
                                           const std::shared_ptr<const Scene>& geometry, std::uint64_t seed);
    void finish(const MeasuredScene& scene, const SharedRun& shared, std::uint64_t seed);
    bool recall(const MeasuredScene& scene, std::size_t setup, std::uint64_t seed);
    void add(const MeasuredScene& scene, std::size_t setup, const std::vector<Measurement>& measurements);
    bool keeps_image(std::uint64_t seed) const;
    nlohmann::json key_of(const MeasuredScene& scene, const Setup& setup, std::uint64_t seed) const;
    void tell(const std::vector<SharedRun>& runs, const std::string& scene);
    ThreadPool& pool(int threads);

    const ExperimentOptions& options_;
    std::vector<Setup> setups_;
    std::vector<MeasuredScene> scenes_;
    std::map<std::array<std::ptrdiff_t, 3>, Result> results_; ///< by scene, setup, and halvings from most to none
    std::map<int, std::unique_ptr<ThreadPool>> pools_;        ///< by their threads
    std::optional<Journal> journal_;
    std::size_t triangles_ = 0; ///< of the scene at hand, as what follows
    SceneChecksums scene_checksums_;
    double renders_ = 0, finished_ = 0; ///< in all, and in this call
    std::optional<Progress> progress_;
    std::chrono::steady_clock::time_point start_;
};

/// The words of `tessera sweep`, `bench` and `stability`, before they are given a meaning.
struct ExperimentWords {
    std::vector<std::string> scenes, variations;
    std::string methods, norms, clock = "cpu";
    int spp = 0;
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
