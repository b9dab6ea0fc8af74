#pragma once

#include "render/run/thread_pool.h"
#include "ui/jobs/background_job.h"

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tessera {

/// What came of writing.
struct Saved {
    Saved(std::string saved, std::function<void()> afterwards = {})
        : what(std::move(saved)), then(std::move(afterwards)) {}

    std::string what;           ///< was saved, and where; empty: nothing that anybody need be told of
    std::function<void()> then; ///< to be called by who takes it; may be empty
};

/// Files to write, one after the other in the background, in the order of their wishes: none of them is given up
/// for a later one. Its end waits until all are written.
class SaveQueue {
public:
    /// Writes. Throws std::exception.
    using Work = std::function<Saved()>;
    using Outcome = BackgroundJob<std::monostate, Saved>::Outcome;

    SaveQueue() = default;
    ~SaveQueue();
    SaveQueue(const SaveQueue&) = delete;
    SaveQueue& operator=(const SaveQueue&) = delete;

    /// `on_done` is called from another thread once take() has the outcome; it may be empty.
    void add(Work work, std::function<void()> on_done);

    bool running() const { return job_.running(); }

    /// What came of the oldest, once; begins the next. Never waits.
    std::optional<Outcome> take();

    /// Writes all that is left, and waits; what came of each that had not been taken.
    std::vector<Outcome> finish();

private:
    struct Waiting {
        Work work;
        std::function<void()> on_done;
    };
    void start_next();

    std::deque<Waiting> waiting_;
    BackgroundJob<std::monostate, Saved> job_;
};

inline SaveQueue::~SaveQueue() {
    finish();
}

inline void SaveQueue::add(Work work, std::function<void()> on_done) {
    waiting_.push_back({std::move(work), std::move(on_done)});
    start_next();
}

inline void SaveQueue::start_next() {
    if (job_.running() || waiting_.empty())
        return;
    Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    job_.start(
        {},
        [work = std::move(next.work)](std::stop_token) {
            work_in_background();
            return work();
        },
        std::move(next.on_done));
}

inline std::vector<SaveQueue::Outcome> SaveQueue::finish() {
    std::vector<Outcome> outcomes;
    for (; job_.running(); start_next())
        outcomes.push_back(*job_.wait());
    return outcomes;
}

inline std::optional<SaveQueue::Outcome> SaveQueue::take() {
    std::optional<Outcome> outcome = job_.take();
    start_next();
    return outcome;
}

} // namespace tessera
