#pragma once

#include "ui/background_job.h"

#include <deque>

namespace tessera {

/// Files to write, one after the other in the background, in the order of their wishes. Its end waits until all
/// are written.
class SaveQueue {
public:
    /// Writes; returns what was saved where, empty: what nobody need be told of. Throws std::exception.
    using Work = std::function<std::string()>;
    using Outcome = BackgroundJob<std::string>::Outcome;

    SaveQueue() = default;
    ~SaveQueue();
    SaveQueue(const SaveQueue&) = delete;
    SaveQueue& operator=(const SaveQueue&) = delete;

    /// `on_done` is called from another thread once poll() has the outcome; it may be empty.
    void add(Work work, std::function<void()> on_done);

    bool running() const { return job_.running(); }

    /// What came of the oldest, once; begins the next. Never waits.
    std::optional<Outcome> poll();

    /// Writes all that is left, and waits; what came of each that had not been polled.
    std::vector<Outcome> finish();

private:
    struct Waiting {
        Work work;
        std::function<void()> on_done;
    };
    void start_next();

    std::deque<Waiting> waiting_;
    BackgroundJob<std::string> job_;
};

} // namespace tessera
