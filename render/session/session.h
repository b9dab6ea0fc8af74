#pragma once

#include "render/run/thread_pool.h"
#include "render/scene/camera.h"
#include "render/session/snapshot.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace tessera {

class Scene;
class Render;

/// How the panes share the cores, and when they rest. No change of it renders anything anew.
struct Pace {
    enum class Equal { time, spp };
    Equal equal = Equal::time; ///< what each pane is to have had as much of as the others
    int spp_limit = 0;         ///< passes after which a pane rests; 0: none
    double seconds_limit = 0;  ///< wall seconds of its passes after which a pane rests; 0: none

    bool is_limit(int spp, double seconds) const {
        return (spp_limit > 0 && spp >= spp_limit) || (seconds_limit > 0 && seconds >= seconds_limit);
    }

    bool operator==(const Pace&) const = default;
};

/// What a pane asks for. Any change is a new request, which starts the pane's render anew.
struct RenderRequest {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    glm::ivec2 size{0};
    RenderSettings settings;
};

/// A reconstruction under way.
struct ReconstructionUnderWay {
    int spp = 0;        ///< of the snapshot that it is made from
    double seconds = 0; ///< that it has taken so far
    float share = 0;    ///< of its steps that are done, [0, 1]
};

/// Renders the panes of a viewer in the background: passes of the panes in turn, so that each has had about the
/// same time (or samples), and their reconstructions on a thread of their own (newest snapshot wins). No call
/// waits for a worker: all may be made from the UI's thread at every frame.
class Session {
public:
    /// `threads` as in ThreadPool. `on_publish` is called from a worker whenever a pane has a new snapshot or a
    /// message; it must be quick and thread-safe (glfwPostEmptyEvent).
    Session(int panes, int threads, std::function<void()> on_publish = {});
    ~Session();

    /// Replaces the pane's request; work on the old one ends within a tile and its results are dropped, all but a
    /// first preview. Returns the generation that snapshots of this request will carry.
    std::uint64_t submit(int pane, RenderRequest request);

    /// Lets a pane show the passes of another, which renders, with a reconstruction of its own: it renders nothing
    /// itself until it is submitted. To be called anew after a submit of the other, of which it has no more than
    /// previews before. Returns the other's generation.
    std::uint64_t follow(int pane, int other);

    /// Ends the pane's work and forgets its picture; until the next submit it takes no turns.
    void withdraw(int pane);

    /// Settings of the pane's reconstruction; a change ends the one under way and reconstructs the newest snapshot
    /// again, renders nothing. Of Norm::oidn without its library there is a message, and the picture is that of
    /// Norm::guided.
    void set_reconstruction(int pane, const ReconstructionSettings& settings);

    /// The reconstruction under way in the pane; empty: there is none.
    std::optional<ReconstructionUnderWay> reconstructing(int pane) const;
    /// Ends the reconstruction under way. What is rendered so far stays without one, until there are other
    /// settings.
    void give_up_reconstruction(int pane);

    void set_paused(bool paused);
    bool paused() const;
    void set_pace(const Pace& pace);
    /// Asks for one more pass of every pane, also while paused or beyond a limit.
    void step();

    /// The pane's newest snapshot; null before the first. It may answer an older request: compare generations.
    std::shared_ptr<const Snapshot> latest(int pane) const;

    /// Whether the render of the pane's request went wrong (there is a message): nothing more will come of it.
    bool has_failed(int pane) const;
    /// Why it did; empty: it has not.
    std::string failure(int pane) const;

    /// The share of the blocks of pixels that the pane's pass under way has done, or its last one had, [0, 1].
    float pass_share(int pane) const;

    /// Messages of errors in workers since the last call (what, with pixel, sample and seed where there is one).
    std::vector<std::string> take_messages();

private:
    struct Pane;
    void render_loop(std::stop_token stop);
    void reconstruct_loop(std::stop_token stop);
    const Pane& rendering(int pane) const;
    void hand_on(const Pane& pane);
    Pane* next_pane();
    std::unique_ptr<Render> withdrawn_render();
    Pane* unpublished_pane();
    void render_pass(Pane& pane, std::stop_token session_stop);
    void tell();
    void report(std::string message);
    void preview(Pane& pane, const RenderRequest& request, std::uint64_t generation, std::stop_token stop);
    double preview_budget() const;
    void give_up(Pane& pane, std::uint64_t generation, const std::string& why);
    void count_step(Pane& pane, std::uint64_t generation);
    static std::shared_ptr<Snapshot> snapshot_of(const Render& render, std::uint64_t generation, int divisor);
    void publish(Pane& pane, const std::shared_ptr<Snapshot>& snapshot);
    void publish_passes(Pane& pane);
    ReconstructionSettings possible_reconstruction(Pane& pane);
    void reconstruct_snapshot(Pane& pane, const Snapshot& snapshot, const ReconstructionSettings& settings,
                              bool anew, std::stop_token stop);

    mutable std::mutex mutex_;
    std::condition_variable_any render_wake_;
    std::condition_variable_any reconstruct_wake_;
    std::vector<std::unique_ptr<Pane>> panes_;
    std::vector<std::string> messages_;
    std::function<void()> on_publish_;
    bool paused_ = false;
    Pace pace_;
    std::uint64_t generation_ = 0;
    std::uint64_t turn_ = 0;
    ThreadPool pool_;
    std::jthread render_thread_;
    std::jthread reconstruct_thread_;
};

} // namespace tessera
