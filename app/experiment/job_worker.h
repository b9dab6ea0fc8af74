// Lists of jobs that several processes share, and the worker that a process runs on such a list.
#pragma once

#include "app/experiment/claim.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace tessera {

/// Jobs that each make one file. All processes that share the work have the same list.
class JobList {
public:
    virtual ~JobList() = default;
    virtual std::size_t size() const = 0;
    /// Returns the file that a job makes; empty: the job cannot start yet.
    virtual std::filesystem::path file_of(std::size_t job) = 0;
    virtual bool is_done(std::size_t job) = 0;
    /// Returns true if another process has recorded that all jobs are done. Checks for one file only.
    virtual bool are_all_done() { return false; }
    /// Notes that the job's file was seen in a folder listing, so that later checks need no file access.
    virtual void found(std::size_t) {}
    /// Runs a job that this process has claimed, and makes its file. Returns false if Ctrl-C interrupted it.
    virtual bool run(std::size_t job, Claim& claim) = 0;
};

/// One of the processes that work on a list. An InterruptGuard must outlive it.
class JobWorker {
public:
    /// @param silence  as in Claims
    JobWorker(JobList& jobs, double silence);

    /// Runs unclaimed jobs until all jobs are done, and calls `after` after each own job but the last. If other
    /// processes hold all remaining jobs, waits until these are done or their claims silent. Returns false if
    /// Ctrl-C interrupted it.
    bool run(const std::function<void()>& after);
    /// Runs this job, which must be ready to start, or waits until another process has done it. Returns false if
    /// Ctrl-C interrupted it.
    bool run_one(std::size_t job);

private:
    enum class State : std::uint8_t { open, taken, done };

    void scan_folders();
    bool is_left() const { return done_ < states_.size(); }
    void set(std::size_t job, State state);
    std::size_t random_position();
    std::size_t next_in(State state);
    std::unique_ptr<Claim> attempt(std::size_t job);
    std::unique_ptr<Claim> find_open();
    std::unique_ptr<Claim> find_silent();

    JobList& jobs_;
    double silence_;
    Claims claims_;
    std::vector<State> states_; ///< state of each job as last seen
    std::size_t open_ = 0, done_ = 0;
    std::chrono::steady_clock::time_point next_scan_{};
    std::size_t position_ = 0; ///< index at which the search for the next job begins
    std::minstd_rand random_{std::random_device()()};
};

/// Waits for a growing interval, at most a tenth of the silence and at most a second. Returns false after Ctrl-C.
class Backoff {
public:
    explicit Backoff(double silence) : silence_(silence) {}
    bool wait();
    void begin_anew() { seconds_ = 0.01; }

private:
    double silence_;
    double seconds_ = 0.01;
};

} // namespace tessera
