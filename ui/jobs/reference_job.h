#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace tessera {

/// Makes references in the background, as `tessera reference` does and to the same bits, on threads that give way
/// to those of the panes. Its end, like a cancellation, waits for the pass under way and leaves a checkpoint.
class ReferenceJob {
public:
    /// To be called every frame: fulfils the wishes to make a reference, and tells how far it is. What is
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
    class Watch;
    /// What it is made of, and where it goes.
    struct Order {
        std::filesystem::path file;
        std::shared_ptr<const Scene> scene;
        Camera camera;
        glm::ivec2 size{0};
        std::shared_ptr<Watch> watch;
    };
    using Job = BackgroundJob<Order, Made>;
    void start(ViewerState& state, int threads, const std::function<void()>& wake);
    static void take(ViewerState& state, const Job::Outcome& outcome);

    Job job_;
};

} // namespace tessera
