// Threads and a progress watch that a caller passes to a solver.
#pragma once

#include <atomic>
#include <functional>
#include <stop_token>
#include <utility>

namespace tessera {

/// Runs body(i) for every i in [0, count), in any order and on any threads, and returns when all are done. Results
/// must not depend on the order.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;

/// Runs everything in the calling thread.
inline void serial_for(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i)
        body(i);
}

/// Receives the progress of a solver between its steps, and tells it to stop.
class SolveWatch {
public:
    SolveWatch() = default;
    /// @param progress  receives the fraction of steps done, in [0, 1], and must outlive the watch; null: no
    /// progress
    SolveWatch(std::stop_token stop, std::atomic<float>* progress = nullptr)
        : stop_(std::move(stop)), progress_(progress) {}

    bool is_stopped() const { return stop_.stop_requested(); }

    /// Records that `done` of `of` steps are done. Returns false if the solver must stop.
    bool goes_on(int done, int of) const {
        if (progress_)
            *progress_ = static_cast<float>(done) / static_cast<float>(of);
        return !is_stopped();
    }

private:
    std::stop_token stop_;
    std::atomic<float>* progress_ = nullptr;
};

} // namespace tessera
