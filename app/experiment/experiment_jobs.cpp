#include "app/experiment/experiment_jobs.h"

#include "app/cli/opened_scene.h"
#include "app/experiment/claim.h"
#include "render/io/files.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace fs = std::filesystem;

ExperimentJobs::ExperimentJobs(const std::vector<Experiment*>& experiments) {
    for (Experiment* experiment : experiments) {
        std::size_t job = 0;
        const std::vector<Experiment::Job>& jobs = experiment->jobs();
        for (std::size_t scene = 0; scene < experiment->scenes().size(); ++scene) {
            for (FolderReference* reference : experiment->scenes()[scene].references())
                items_.push_back({experiment, scene, reference, 0});
            for (; job < jobs.size() && jobs[job].scene == scene; ++job)
                items_.push_back({experiment, scene, nullptr, job});
        }
        job_count_ += jobs.size();
    }
    is_done_.resize(items_.size());
}

fs::path ExperimentJobs::file_of(std::size_t item) {
    const Item& i = items_[item];
    return i.reference ? i.reference->path() : i.experiment->file_of(i.job);
}

bool ExperimentJobs::is_done(std::size_t item) {
    const Item& i = items_[item];
    if (!is_done_[item])
        is_done_[item] = i.reference ? i.reference->look() : i.experiment->is_done(i.job);
    return is_done_[item] != 0;
}

void ExperimentJobs::found(std::size_t item) {
    const Item& i = items_[item];
    is_done_[item] = !i.reference || i.reference->look();
}

bool ExperimentJobs::run(std::size_t item, Claim& claim) {
    const Item& i = items_[item];
    const auto done = static_cast<std::size_t>(std::count(is_done_.begin(), is_done_.end(), 1));
    if (!done_at_first_) {
        done_at_first_ = done;
        start_ = std::chrono::steady_clock::now();
    }
    if (i.reference) {
        progress_.reset(); // a reference shows its own progress
        is_done_[item] = i.experiment->render_reference(i.scene, *i.reference);
        return is_done_[item] != 0;
    }
    if (!progress_)
        progress_.emplace("measuring");
    is_done_[item] = i.experiment->run(i.job, claim, [&](double fraction) { show_progress(i, fraction); });
    if (is_done_[item] && done + 1 == items_.size())
        progress_.reset();
    return is_done_[item] != 0;
}

void ExperimentJobs::show_progress(const Item& item, double fraction) {
    const auto done = static_cast<double>(std::count(is_done_.begin(), is_done_.end(), 1));
    const auto first = static_cast<double>(*done_at_first_), all = static_cast<double>(items_.size());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    const Experiment::Job& job = item.experiment->jobs()[item.job];
    progress_->update((done - first + fraction) / (all - first), seconds.count(),
                      fmt::format("{}, {:g} of {:g} jobs done", item.experiment->text_of(job), done, all));
}

std::vector<std::size_t> ExperimentJobs::items_for(int number) const {
    int count = 0;
    for (std::size_t item = 0; item < items_.size(); ++item) {
        if (items_[item].reference || ++count != number)
            continue;
        std::vector<std::size_t> needed;
        for (std::size_t other = 0; other < item; ++other)
            if (items_[other].reference && items_[other].experiment == items_[item].experiment &&
                items_[other].scene == items_[item].scene)
                needed.push_back(other);
        needed.push_back(item);
        return needed;
    }
    throw BadInput(fmt::format("--job {}: there are {} jobs", number, count));
}

std::size_t ExperimentJobs::left() {
    if (are_all_done())
        return 0;
    std::size_t left = 0;
    for (std::size_t item = 0; item < items_.size(); ++item)
        left += !items_[item].reference && !is_done(item);
    return left;
}

std::string ExperimentJobs::list() {
    std::string text;
    int number = 0;
    for (std::size_t item = 0; item < items_.size(); ++item) {
        const Item& i = items_[item];
        if (i.reference)
            continue;
        const bool done = is_done(item);
        const double seconds = i.experiment->estimate(i.job);
        const std::string owner = done || file_of(item).empty() ? "" : Claims::owner_of(file_of(item));
        const std::string about = std::isnan(seconds) ? "-" : fmt::format("{:.3g} s", seconds);
        text += fmt::format("{}\t{}\t{}\t{}\n", ++number,
                            done            ? "done"
                            : owner.empty() ? "open"
                                            : "claimed by " + owner,
                            about, i.experiment->text_of(i.experiment->jobs()[i.job]));
    }
    return text;
}

JobPlan ExperimentJobs::plan(const fs::path& folder) {
    JobPlan plan;
    std::map<const Experiment*, std::size_t> works;
    const auto relative = [from = fs::absolute(folder).lexically_normal()](const fs::path& file) {
        return file.empty() ? fs::path() : fs::absolute(file).lexically_normal().lexically_proximate(from);
    };
    for (std::size_t item = 0; item < items_.size(); ++item) {
        const Item& i = items_[item];
        const auto [work, is_new] = works.try_emplace(i.experiment, plan.works.size());
        if (is_new) {
            plan.works.push_back({i.experiment->options(), {}});
            for (const MeasuredScene& scene : i.experiment->scenes())
                plan.works.back().scenes.push_back(scene.name());
        }
        const fs::path file = file_of(item);
        JobPlan::Job& job = plan.jobs.emplace_back();
        job.work = work->second;
        job.what = i.reference ? "reference " + file.filename().string()
                               : i.experiment->text_of(i.experiment->jobs()[i.job]);
        job.file = relative(file);
        job.is_reference = i.reference != nullptr;
        if (!i.reference)
            std::ranges::transform(i.experiment->known_in(i.job), std::back_inserter(job.known_in), relative);
    }
    return plan;
}

bool ExperimentJobs::are_all_done() {
    const std::string name = marks_.empty() ? "" : mark();
    return !name.empty() && fs::exists(marks_ / name);
}

std::string ExperimentJobs::mark() {
    if (!mark_.empty())
        return mark_;
    std::string names;
    for (std::size_t item = 0; item < items_.size(); ++item) {
        const fs::path file = file_of(item);
        if (file.empty())
            return "";
        if (!items_[item].reference)
            names += file.filename().string() + "\n";
    }
    return mark_ = fmt::format("report-{:08x}", checksum(std::as_bytes(std::span(names))));
}

namespace {

/// The report of a command. One process writes it at a time, under a claim. A file named by
/// ExperimentJobs::mark() records that the final report is written.
class Report {
public:
    Report(ExperimentJobs& jobs, const ExperimentOptions& options, const std::function<void()>& write)
        : jobs_(jobs), options_(options), folder_(options.output / "jobs"), silence_(options.sharing.silence),
          claims_(silence_), write_(write) {}

    /// Removes the record that the final report is written. To be called while jobs are unfinished.
    void forget() {
        if (const std::string mark = jobs_.mark(); !mark.empty())
            fs::remove(folder_ / mark);
    }

    /// Writes the plan, until it has the names of all files: these depend on the references. A plan that cannot
    /// be written only causes a warning, since only viewers of the folder need it.
    void write_plan() {
        if (is_plan_whole_)
            return;
        const bool is_whole = !jobs_.mark().empty();
        const JobPlan plan = jobs_.plan(options_.output);
        try {
            tessera::write_plan(plan_file(options_.output), plan);
            is_plan_whole_ = is_whole;
        } catch (const std::runtime_error& error) {
            if (!std::exchange(has_warned_, true))
                fmt::print(stderr, "warning: {}\n", error.what());
        }
    }

    /// Writes a report of the finished jobs, unless another process is writing one.
    void write_if_free() {
        if (const std::unique_ptr<Claim> claim = claims_.take(folder_ / "report"))
            write_();
    }

    /// Writes a report if enough time has passed since the last one.
    void write_now_and_then() {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point begin = Clock::now();
        if (begin < next_)
            return;
        write_plan(); // references may have been finished since
        write_if_free();
        constexpr int pauses = 20;
        const Clock::time_point end = Clock::now();
        next_ = end + pauses * (end - begin);
    }

    /// Writes the final report, unless another process has written it and `always` is not set.
    void write_last(bool always) {
        const fs::path written = folder_ / jobs_.mark();
        for (Backoff patience(silence_); always || !fs::exists(written);) {
            const std::unique_ptr<Claim> claim = claims_.take(folder_ / "report");
            if (!claim) {
                if (!patience.wait())
                    return;
                continue;
            }
            if (always || !fs::exists(written)) {
                write_();
                write_text(written, worker_name() + "\n");
            }
            return;
        }
    }

private:
    ExperimentJobs& jobs_;
    const ExperimentOptions& options_;
    fs::path folder_;
    double silence_;
    Claims claims_;
    bool is_plan_whole_ = false; ///< the written plan has the names of all files
    bool has_warned_ = false;    ///< that the plan cannot be written
    const std::function<void()>& write_;
    std::chrono::steady_clock::time_point next_{};
};

/// Performs the task on the jobs. Returns false if Ctrl-C interrupted it.
bool work(ExperimentJobs& jobs, const WorkDivision& sharing, Report& report) {
    if (sharing.task == WorkDivision::Task::report)
        return true;
    JobWorker worker(jobs, sharing.silence);
    if (sharing.task == WorkDivision::Task::work)
        return worker.run([&] { report.write_now_and_then(); });
    const std::vector<std::size_t> items = jobs.items_for(sharing.job);
    return std::all_of(items.begin(), items.end(), [&](std::size_t item) { return worker.run_one(item); });
}

} // namespace

int run_jobs(const std::vector<Experiment*>& experiments, const ExperimentOptions& options,
             const std::function<void()>& write_report) {
    const InterruptGuard guard;
    ExperimentJobs jobs(experiments);
    if (options.sharing.task == WorkDivision::Task::list) {
        fmt::print("{}", jobs.list());
        return exit_ok;
    }
    make_folder(options.output / "jobs");
    Report report(jobs, options, write_report);
    report.write_plan();
    const bool was_done = jobs.left() == 0;
    if (!was_done)
        report.forget();
    jobs.set_completion_folder(options.output / "jobs"); // from here on the mark is valid
    const bool has_ended = work(jobs, options.sharing, report);
    report.write_plan(); // references may have been finished since
    const std::size_t left = jobs.left();
    const bool is_of_one = options.sharing.task == WorkDivision::Task::one_job;
    if (left == 0)
        report.write_last(was_done);
    else if (!is_of_one)
        report.write_if_free();
    if (has_ended && (left == 0 || is_of_one))
        return exit_ok;
    fmt::print(stderr, "{}: not complete, {} of {} jobs are left; run the same command again to continue\n",
               options.output.string(), left, jobs.job_count());
    return exit_failure;
}

} // namespace tessera
