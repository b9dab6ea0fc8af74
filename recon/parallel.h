// What a caller lends a solver: threads, and a watch.
#pragma once

#include <atomic>
#include <functional>
#include <stop_token>
#include <utility>

namespace tessera {

/// Runs body(i) for every i in [0, count), in any order and on any threads; returns when all are done.
/// The result must not depend on the order: whoever passes one in decides on the threads.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;

/// The ParallelFor of the calling thread alone.
inline void serial_for(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i)
        body(i);
}

/// A watch of a solver: it is told between steps how far that is, and says whether to go on.
class SolveWatch {
public:
    SolveWatch() = default;
    /// @param share  set to the share of the steps that is done, [0, 1]; null: nobody wants to know. It must live
    /// as long.
    SolveWatch(std::stop_token stop, std::atomic<float>* share = nullptr)
        : stop_(std::move(stop)), share_(share) {}

    bool is_stopped() const { return stop_.stop_requested(); }

    /// Tells that `done` of `of` steps are done. False: the solver is to stop.
    bool goes_on(int done, int of) const {
        if (share_)
            *share_ = static_cast<float>(done) / static_cast<float>(of);
        return !is_stopped();
    }

private:
    std::stop_token stop_;
    std::atomic<float>* share_ = nullptr;
};

} // namespace tessera
