// Lists of jobs that any number of processes do together, and one of those that do.
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

/// Jobs, each of which makes one file. All processes that share them have the same list.
class JobList {
public:
    virtual ~JobList() = default;
    virtual std::size_t size() const = 0;
    /// The file that a job makes. Empty: it cannot be begun yet.
    virtual std::filesystem::path file_of(std::size_t job) = 0;
    virtual bool is_done(std::size_t job) = 0;
    /// Whether it is known, at the cost of a look for one file, that another process has found all of them done.
    virtual bool are_all_done() { return false; }
    /// Says that the job's file was seen in its folder, so that nobody needs to look again.
    virtual void found(std::size_t) {}
    /// Does a job that this process has claimed, and makes its file. False: Ctrl-C ended it.
    virtual bool run(std::size_t job, Claim& claim) = 0;
};

/// One of the processes that do the jobs of a list. An InterruptGuard must live as long.
class JobWorker {
public:
    /// @param silence  as in Claims
    JobWorker(JobList& jobs, double silence);

    /// Does jobs that nobody else does until all are done, and calls `after` after each of its own but the last.
    /// Where all that are left are others', it waits until they are done, or silent. False: Ctrl-C ended it.
    bool run(const std::function<void()>& after);
    /// Does this one, which must be one that can be begun, or waits until another has done it. False: Ctrl-C ended
    /// it.
    bool run_one(std::size_t job);

private:
    enum class State : std::uint8_t { open, taken, done };

    void look();
    bool is_left() const { return done_ < states_.size(); }
    void set(std::size_t job, State state);
    std::size_t anywhere();
    std::size_t next(State state);
    std::unique_ptr<Claim> attempt(std::size_t job);
    std::unique_ptr<Claim> find_open();
    std::unique_ptr<Claim> find_silent();

    JobList& jobs_;
    double silence_;
    Claims claims_;
    std::vector<State> states_; ///< as far as this process knows
    std::size_t open_ = 0, done_ = 0;
    std::chrono::steady_clock::time_point next_look_{};
    std::size_t place_ = 0; ///< in the list, from which on it looks for the next
    std::minstd_rand chance_{std::random_device()()};
};

/// Waits for a moment, each time for longer, up to a tenth of the silence and a second. False: there is an
/// interrupt.
class Patience {
public:
    explicit Patience(double silence) : silence_(silence) {}
    bool wait();
    void begin_anew() { seconds_ = 0.01; }

private:
    double silence_;
    double seconds_ = 0.01;
};

} // namespace tessera
