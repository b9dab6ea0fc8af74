#pragma once

#include "ui/jobs/background_job.h"

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

/// What came of writing.
struct Saved {
    Saved(std::string saved, std::function<void()> afterwards = {})
        : what(std::move(saved)), then(std::move(afterwards)) {}

    std::string what;           ///< was saved, and where; empty: nothing that anybody need be told of
    std::function<void()> then; ///< to be called by who polls; may be empty
};

/// Files to write, one after the other in the background, in the order of their wishes. Its end waits until all
/// are written.
class SaveQueue {
public:
    /// Writes. Throws std::exception.
    using Work = std::function<Saved()>;
    using Outcome = BackgroundJob<Saved>::Outcome;

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
    BackgroundJob<Saved> job_;
};

} // namespace tessera
