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

/// All that a command is to do, scene by scene: the references that are missing, then the experiments' jobs. These
/// are numbered from 1 on, which depends on nothing but the command.
class ExperimentJobs final : public JobList {
public:
    /// The experiments must live as long.
    explicit ExperimentJobs(const std::vector<Experiment*>& experiments);

    std::size_t size() const override { return items_.size(); }
    std::filesystem::path file_of(std::size_t item) override;
    bool is_done(std::size_t item) override;
    void found(std::size_t item) override;
    bool are_all_done() override;
    bool run(std::size_t item, Claim& claim) override;

    /// The items that the job of that number takes: references, and itself. Throws BadInput where there is no such
    /// job.
    std::vector<std::size_t> items_for(int number) const;
    /// Jobs that are not done, references not counted.
    std::size_t left();
    /// Where it stands, under the name of mark(), that the last report is written; it must stand nowhere while a
    /// job is left. By itself nowhere.
    void keep_marks_in(std::filesystem::path folder) { marks_ = std::move(folder); }
    std::size_t job_count() const { return job_count_; }
    /// A line for each job: its number, what it renders, and whether it is done, being done on a host, or about
    /// how long it takes.
    std::string list();
    /// All of them, as far as it is known, for those who look at `folder`: the one that the output is in.
    JobPlan plan(const std::filesystem::path& folder);
    /// A name for a file that depends on all that the jobs' files are named by; empty: a reference is missing.
    std::string mark();

private:
    struct Item {
        Experiment* experiment;
        std::size_t scene;
        FolderReference* reference; ///< null: it is a job
        std::size_t job;
    };

    void tell(const Item& item, double share);

    std::vector<Item> items_;
    std::filesystem::path marks_;
    std::string mark_;                  ///< mark(), once it is known
    std::vector<std::uint8_t> is_done_; ///< 1: it was when it was last asked for
    std::size_t job_count_ = 0;
    std::optional<std::size_t> done_at_first_; ///< when this process began its first job
    std::optional<Progress> progress_;
    std::chrono::steady_clock::time_point start_;
};

/// Does what the experiments' options ask for of their jobs: works on them, all or one, lists them, or only
/// reports. `report` writes the reports of what is there: it is called now and then, so that it takes no more than
/// a twentieth of the time, and when all is done by the one who finds that first; at any time by one process
/// alone. Returns an ExitCode: failure where not all is done that was asked for. Throws as Experiment does.
int run_jobs(const std::vector<Experiment*>& experiments, const ExperimentOptions& options,
             const std::function<void()>& report);

} // namespace tessera
