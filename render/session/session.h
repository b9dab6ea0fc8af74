#pragma once

#include "render/scene/camera.h"
#include "render/session/snapshot.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

class Scene;
class ReconstructionWorker;
class RenderWorker;
struct SessionPane;
struct SessionState;

/// Division of the cores among panes, and limits at which they rest. A change restarts no render.
struct Pace {
    enum class Equal { time, spp };
    Equal equal = Equal::time; ///< quantity that is equal in all panes
    int spp_limit = 0;         ///< passes after which a pane rests; 0: no limit
    double seconds_limit = 0;  ///< wall time of its passes after which a pane rests, seconds; 0: no limit

    bool is_limit(int spp, double seconds) const { // whether a limit is reached
        return (spp_limit > 0 && spp >= spp_limit) || (seconds_limit > 0 && seconds >= seconds_limit);
    }

    bool operator==(const Pace&) const = default;
};

/// A render that a pane asks for. Any change is a new request, which restarts the pane's render.
struct RenderRequest {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    glm::ivec2 size{0};
    RenderSettings settings;
};

/// A running reconstruction.
struct RunningReconstruction {
    int spp = 0;        ///< samples per pixel of its snapshot
    double seconds = 0; ///< wall time since its start
    float share = 0;    ///< finished fraction of its steps, [0, 1]
};

/// Renders the panes of a viewer in the background: a RenderWorker renders passes of the panes in turn, at equal
/// time or equal samples, and a ReconstructionWorker reconstructs the newest snapshots. No call waits for a
/// worker: the UI's thread may make all of them at every frame.
class Session {
public:
    /// @param threads     as in ThreadPool
    /// @param on_publish  is called by a worker after each new snapshot or message; must be quick and thread-safe,
    ///                    such as glfwPostEmptyEvent()
    Session(int panes, int threads, std::function<void()> on_publish = {});
    ~Session();

    /// Replaces the pane's request. Work on the old one ends within a block of pixels, and its results are
    /// dropped, except a first preview. Returns the generation of the new request, which its snapshots have.
    std::uint64_t submit(int pane, RenderRequest request);

    /// Lets a pane show the passes of another pane with its own reconstruction. It renders nothing until its next
    /// submit(). After a submit() of the other pane, it shows only that pane's previews until follow() is called
    /// again. Returns the other pane's generation.
    std::uint64_t follow(int pane, int other);

    /// Ends the pane's work and drops its picture. The pane gets no turns until its next submit().
    void withdraw(int pane);

    /// Sets the pane's reconstruction. A change stops the running reconstruction and reconstructs the newest
    /// snapshot again, without rendering. Norm::oidn without its library becomes Norm::guided, with a message.
    void set_reconstruction(int pane, const ReconstructionSettings& settings);

    /// Returns the pane's running reconstruction, or empty.
    std::optional<RunningReconstruction> reconstructing(int pane) const;
    /// Stops the running reconstruction. The newest snapshot stays without one until the settings change.
    void stop_reconstruction(int pane);

    void set_paused(bool paused);
    bool paused() const;
    void set_pace(const Pace& pace);
    /// Requests one more pass of every pane, even in pause or at a limit.
    void step();

    /// Returns the pane's newest snapshot; null before the first. It may be of an older request: compare
    /// generations.
    std::shared_ptr<const Snapshot> latest(int pane) const;

    /// Returns whether the render of the pane's request failed. No more snapshots of it follow.
    bool has_failed(int pane) const;
    /// Returns the reason of the failure; empty: none.
    std::string failure(int pane) const;

    /// Returns the finished fraction of the pane's current or last pass, [0, 1].
    float pass_progress(int pane) const;

    /// Returns the error messages of workers since the last call, with pixel, sample and seed where they are
    /// known.
    std::vector<std::string> take_messages();

private:
    SessionPane& pane(int index) const;

    std::unique_ptr<SessionState> shared_;
    std::unique_ptr<RenderWorker> render_;
    std::unique_ptr<ReconstructionWorker> reconstruct_;
};

} // namespace tessera
