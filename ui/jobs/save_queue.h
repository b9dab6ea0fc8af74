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

/// Result of writing a file.
struct Saved {
    Saved(std::string saved, std::function<void()> afterwards = {})
        : what(std::move(saved)), then(std::move(afterwards)) {}

    std::string what;           ///< description of the saved file, for a message; empty: no message
    std::function<void()> then; ///< called by the code that takes the outcome; may be empty
};

/// Writes files in the background, one after the other, in the order of add(). The destructor waits until all are
/// written.
class SaveQueue {
public:
    /// Writes a file. Throws std::exception.
    using Work = std::function<Saved()>;
    using Outcome = BackgroundJob<std::monostate, Saved>::Outcome;

    SaveQueue() = default;
    ~SaveQueue();
    SaveQueue(const SaveQueue&) = delete;
    SaveQueue& operator=(const SaveQueue&) = delete;

    /// Adds a file. `on_done` is called from another thread once take() has the outcome; it may be empty.
    void add(Work work, std::function<void()> on_done);

    bool running() const { return job_.running(); }

    /// Returns the outcome of the oldest file once, and starts the next. Empty: no file is complete. Never waits.
    std::optional<Outcome> take();

    /// Waits until all files are written. Returns the outcomes that take() has not returned.
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
            lower_priority();
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
