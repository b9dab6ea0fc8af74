#pragma once

#include "app/cli/terminal.h"
#include "app/experiment/experiment.h"
#include "app/experiment/job_worker.h"
#include "app/experiment/plan.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

/// All work of a command, scene by scene: first the missing references, then the jobs of the experiments. The
/// jobs' numbers start at 1 and depend only on the command.
class ExperimentJobs final : public JobList {
public:
    /// The experiments must outlive this.
    explicit ExperimentJobs(const std::vector<Experiment*>& experiments);

    std::size_t size() const override { return items_.size(); }
    std::filesystem::path file_of(std::size_t item) override;
    bool is_done(std::size_t item) override;
    void found(std::size_t item) override;
    bool are_all_done() override;
    bool run(std::size_t item, Claim& claim) override;

    /// Returns the items that a job needs: its references and the job itself. Throws BadInput if there is no job
    /// of that number.
    std::vector<std::size_t> items_for(int number) const;
    /// Returns the number of unfinished jobs, not counting references.
    std::size_t left();
    /// Sets the folder in which a file of the name mark() states that the final report is written. The file must
    /// not exist while a job is unfinished. Default: no folder, so are_all_done() is false.
    void set_completion_folder(std::filesystem::path folder) { marks_ = std::move(folder); }
    std::size_t job_count() const { return job_count_; }
    /// Returns a line for each job: its number, its state (done, open, claimed by a worker), an estimate of its
    /// time, and its contents.
    std::string list();
    /// Returns the plan of all items whose files are known, with paths relative to `folder`, the output folder.
    JobPlan plan(const std::filesystem::path& folder);
    /// Returns a name that depends on the names of all jobs' files; empty: a reference is missing.
    std::string mark();

private:
    struct Item {
        Experiment* experiment;
        std::size_t scene;
        FolderReference* reference; ///< null: the item is a job
        std::size_t job;
    };

    void show_progress(const Item& item, double fraction);

    std::vector<Item> items_;
    std::filesystem::path marks_;
    std::string mark_;                         ///< mark(), once it is known
    std::vector<std::uint8_t> is_done_;        ///< cached mark(); empty: not known yet
    std::size_t job_count_ = 0;                ///< 1: was done when last checked
    std::optional<std::size_t> done_at_first_; ///< when this process began its first job
    std::optional<Progress> progress_;         ///< items done when this process began its first one
    std::chrono::steady_clock::time_point start_;
};

/// Performs the task of the options: works on all jobs or on one, lists them, or only writes the report.
/// `report` writes the reports of the finished jobs. Only one process calls it at a time: from time to time, for
/// at most about 5 % of the run time, and once more when all jobs are done. Returns an ExitCode: failure if
/// requested jobs are not finished. Throws as Experiment does.
int run_jobs(const std::vector<Experiment*>& experiments, const ExperimentOptions& options,
             const std::function<void()>& report);

} // namespace tessera
