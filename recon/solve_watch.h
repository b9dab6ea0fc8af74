#pragma once

#include <atomic>
#include <stop_token>
#include <utility>

namespace tessera {

/// What a solver asks, and tells, between its steps.
class SolveWatch {
public:
    SolveWatch() = default;
    /// @param share  set to the share of the steps that is done, [0, 1]; null: nobody wants to know. It must live
    /// as long.
    SolveWatch(std::stop_token stop, std::atomic<float>* share = nullptr)
        : stop_(std::move(stop)), share_(share) {}

    bool is_stopped() const { return stop_.stop_requested(); }

    /// So many of all steps are done. Whether to go on.
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
