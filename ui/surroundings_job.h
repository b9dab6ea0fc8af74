#pragma once

#include "ui/background_job.h"
#include "ui/viewer_state.h"

#include <functional>

namespace tessera {

/// Finds out in the background what lies around the paths that are looked at.
class SurroundingsJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

    /// Whether they are still being found out.
    bool running() const { return job_.running(); }

private:
    struct View {
        std::weak_ptr<const Scene> scene; // not kept alive by what was found in it
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const View& other) const {
            return scene.lock() == other.scene.lock() && camera == other.camera && size == other.size;
        }
    };
    static std::shared_ptr<const Surroundings> find(const Scene& scene, const View& view, std::stop_token stop);

    BackgroundJob<std::shared_ptr<const Surroundings>> job_;
    View asked_; // last
};

} // namespace tessera
