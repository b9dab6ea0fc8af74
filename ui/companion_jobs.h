#pragma once

#include "ui/background_job.h"
#include "ui/viewer_state.h"

#include <functional>
#include <string>

namespace tessera {

/// Makes in the background what some buffers need beside a snapshot, and puts it into the state: the reference
/// that is wished for, and the first hits of what the panes show, once one of them wants to see any.
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
    void update_reference(ViewerState& state, const std::function<void()>& wake);
    void update_first_hits(ViewerState& state, const std::function<void()>& wake);

    BackgroundJob<std::shared_ptr<const Reference>> reference_;
    BackgroundJob<std::shared_ptr<const FirstHits>> first_hits_;
    View asked_; // by the last job that was started
};

} // namespace tessera
