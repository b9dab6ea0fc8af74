#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>

namespace tessera {

/// Makes in the background what some buffers need beside a snapshot, and puts it into the state: the reference
/// that is wished for, and the first hits of what the panes show, once one of them wants to see any. Says so where
/// the reference knows that it shows something else than the panes.
class CompanionJobs {
public:
    /// To be called every frame. `wake` is called from other threads when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// What first hits depend on, and how large they are.
    struct View {
        std::weak_ptr<const Scene> scene; // not kept alive by what was made of it
        Camera camera;
        glm::ivec2 size{0};
        int divisor = 0; // of the size; 0: nothing was traced
    };
    static bool is_of(const View& view, const ViewerState& state);
    void take_first_hits(ViewerState& state);
    void start_reference(std::string file, const std::function<void()>& wake);
    void update_reference(ViewerState& state, const std::function<void()>& wake);
    void check_reference(ViewerState& state, const std::function<void()>& wake);
    void update_first_hits(ViewerState& state, const std::function<void()>& wake);

    std::string reference_file_;                     // that is read, ...
    std::shared_ptr<std::atomic<float>> share_read_; // ... and how far, told by the job
    BackgroundJob<std::shared_ptr<const Reference>> reference_;
    BackgroundJob<std::string> check_; // of the reference: in what it differs
    std::weak_ptr<const Reference> checked_reference_;
    std::weak_ptr<const Scene> checked_scene_;
    BackgroundJob<std::shared_ptr<const FirstHits>> first_hits_;
    View asked_; // by the last job of first hits that was started
    View hit_;   // what the first hits of the state are of
};

} // namespace tessera
