#pragma once

#include "ui/jobs/jobs.h"

#include <functional>

namespace tessera {

/// Computes in the background what the state needs beside the renders: the reference and first hits, the contents
/// of path inspector and slow motion, the charts' numbers, and references to be made.
class BackgroundWork {
public:
    /// Takes in results and starts what the state lacks. To be called every frame.
    /// @param seconds  since the last frame
    /// @param threads  of the renders that make references, as in ThreadPool
    /// @param wake     called from other threads when there is something new
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
    ReferenceJob reference_; // last: its destructor waits for a pass
};

} // namespace tessera
