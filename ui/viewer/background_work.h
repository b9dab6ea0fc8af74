#pragma once

#include "ui/jobs/jobs.h"

#include <functional>

namespace tessera {

/// Runs the background jobs of the viewer except the renders: references, first hits, charts, path inspector and
/// slow motion.
class BackgroundWork {
public:
    /// Puts results into the state and starts the jobs that it lacks. To be called every frame.
    /// @param seconds  time since the last frame
    /// @param threads  number of threads of a reference render, as in ThreadPool
    /// @param wake     called from other threads when a job has news
    void update(ViewerState& state, float seconds, int threads, const std::function<void()>& wake) {
        companions_.update(state, wake);
        inspection_.update(state, wake);
        slow_motion_.update(state, seconds, wake);
        surroundings_.update(state, wake);
        reference_.update(state, threads, wake);
        charts_.update(state, wake);
    }

    /// Whether the contents of the path inspector are incomplete.
    bool inspecting() const { return inspection_.running() || surroundings_.running(); }

private:
    CompanionJobs companions_;
    InspectionJob inspection_;
    SlowMotionJob slow_motion_;
    SurroundingsJob surroundings_;
    ChartJob charts_;
    ReferenceJob reference_; // last, because its destructor waits for the pass under way
};

} // namespace tessera
