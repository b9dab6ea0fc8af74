#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <functional>
#include <memory>
#include <vector>

namespace tessera {

/// Makes references in the background, as `tessera reference` does and to the same bits, on threads that give way
/// to those of the panes. Its end, like a cancellation, stops the pass under way and leaves a checkpoint.
class ReferenceJob {
public:
    /// To be called every frame: fulfils the wishes of state.reference_making, and tells how far it is. What is
    /// complete becomes the reference of the state if its scene, camera and size are still what the panes show.
    /// `threads` as in ThreadPool; `wake` is called from another thread when there is something new.
    void update(ViewerState& state, int threads, const std::function<void()>& wake);

private:
    /// What one of its renders has counted.
    struct Counted {
        RenderSettings settings;
        Counters counters;
    };
    /// What has become of it.
    struct Made {
        std::optional<FloorFreeError> error; ///< of a complete one; empty: it was cancelled
        int spp = 0;
        std::vector<Counted> halves;
    };
    /// What it is made of.
    struct Subject {
        std::shared_ptr<const Scene> scene;
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const Subject&) const = default;
    };
    class Watch;
    void start(ViewerState& state, int threads, const std::function<void()>& wake);
    void take(ViewerState& state, BackgroundJob<Made>::Outcome outcome);

    std::shared_ptr<Watch> watch_; // of the job under way
    Subject subject_;
    BackgroundJob<Made> job_;
};

} // namespace tessera
