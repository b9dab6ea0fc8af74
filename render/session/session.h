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

/// How the panes share the cores, and when they rest. A change of it restarts no render.
struct Pace {
    enum class Equal { time, spp };
    Equal equal = Equal::time; ///< measure that is equal in all panes
    int spp_limit = 0;         ///< passes after which a pane rests; 0: none
    double seconds_limit = 0;  ///< wall seconds of its passes after which a pane rests; 0: none

    bool is_limit(int spp, double seconds) const {
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

/// A reconstruction under way.
struct ReconstructionUnderWay {
    int spp = 0;        ///< samples per pixel of its snapshot
    double seconds = 0; ///< since its start
    float share = 0;    ///< fraction of its steps that are done, [0, 1]
};

/// Renders the panes of a viewer in the background: a RenderWorker renders passes of the panes in turn, at equal
/// time or equal samples, and a ReconstructionWorker reconstructs the newest snapshots. No call waits for a
/// worker: the UI's thread may make all of them at every frame.
class Session {
public:
    /// `threads` as in ThreadPool. `on_publish` is called from a worker whenever a pane has a new snapshot or a
    /// message; it must be quick and thread-safe (glfwPostEmptyEvent).
    Session(int panes, int threads, std::function<void()> on_publish = {});
    ~Session();

    /// Replaces the pane's request. Work on the old one ends within a tile, and its results are dropped, except a
    /// first preview. Returns the generation of the request's snapshots.
    std::uint64_t submit(int pane, RenderRequest request);

    /// Lets a pane show the passes of another pane with a reconstruction of its own. It renders nothing itself
    /// until its next submit. To be called again after a submit of the other pane; it shows only that one's
    /// previews until then. Returns the other pane's generation.
    std::uint64_t follow(int pane, int other);

    /// Ends the pane's work and drops its picture. It gets no turns until its next submit.
    void withdraw(int pane);

    /// Sets how the pane is reconstructed. A change ends the reconstruction under way, reconstructs the newest
    /// snapshot again, and renders nothing. Norm::oidn without its library becomes Norm::guided, with a message.
    void set_reconstruction(int pane, const ReconstructionSettings& settings);

    /// Returns the reconstruction under way in the pane; empty: none is.
    std::optional<ReconstructionUnderWay> reconstructing(int pane) const;
    /// Ends the reconstruction under way. The newest snapshot stays without one until the settings change.
    void give_up_reconstruction(int pane);

    void set_paused(bool paused);
    bool paused() const;
    void set_pace(const Pace& pace);
    /// Requests one more pass of every pane, even if it is paused or at a limit.
    void step();

    /// Returns the pane's newest snapshot; null before the first. It may be of an older request: compare
    /// generations.
    std::shared_ptr<const Snapshot> latest(int pane) const;

    /// Whether the render of the pane's request failed, with a message. No more snapshots of it follow.
    bool has_failed(int pane) const;
    /// Returns the reason of the failure; empty: the render has not failed.
    std::string failure(int pane) const;

    /// Returns the fraction of the pixel blocks that are done in the pane's pass under way, or its last one, [0,
    /// 1].
    float pass_share(int pane) const;

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
