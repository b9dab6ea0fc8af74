#pragma once

#include "render/run/render.h"
#include "render/session/previews.h"
#include "render/session/session.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

namespace tessera {

/// The render of a pane. Only the render thread uses it.
struct PaneRender {
    Previews previews;
    std::unique_ptr<Render> render;
    std::uint64_t generation = 0; // of the rendered request
    int published_spp = 0;
    std::chrono::steady_clock::time_point published_at;
    std::uint64_t served = 0; // number of the pane's last turn

    bool has_unpublished_passes() const { return render && published_spp < render->spp(); }
};

/// The reconstruction of a pane: requested, running and newest. Guarded by SessionState::mutex, except `share`.
struct PaneReconstruction {
    ReconstructionSettings settings;
    std::stop_source stop; // stops the running one

    std::shared_ptr<const GradientImages> made_from; // images of the newest one
    ReconstructionSettings made_with;                // settings of the newest one

    int spp = 0;                                 // samples per pixel of the running one; 0: none is running
    std::chrono::steady_clock::time_point since; // start of the running one
    std::atomic<float> share = 0;                // finished fraction of its steps

    std::weak_ptr<const GradientImages> given_up; // images whose reconstruction the user stopped
    std::weak_ptr<const GradientImages> renewed;  // images of the last cold start

    void end() {
        stop.request_stop();
        stop = std::stop_source();
    }
};

/// Keeps the solver's state from one snapshot to the next. Only the reconstruction thread uses it.
class WarmSolver {
public:
    /// Returns the solver. It starts warm if the last snapshot was of the same render and settings, otherwise
    /// cold.
    /// @param cold  start cold in any case
    Reconstructor& solver_for(const Snapshot& snapshot, const ReconstructionSettings& settings, bool cold) {
        if (cold || generation_ != snapshot.generation || divisor_ != snapshot.divisor || settings_ != settings)
            reconstructor_.forget();
        generation_ = snapshot.generation;
        divisor_ = snapshot.divisor;
        settings_ = settings;
        return reconstructor_;
    }

private:
    Reconstructor reconstructor_;
    // These describe the last snapshot.
    std::uint64_t generation_ = 0;
    int divisor_ = 0;
    ReconstructionSettings settings_;
};

/// A pane of a session. Guarded by SessionState::mutex, except `pass_progress`, `own` and `solver`.
struct SessionPane {
    RenderRequest request;
    std::uint64_t generation = 0; // of the request; 0: none yet
    int followed = -1;            // pane whose passes it shows, without a request of its own; -1: none
    std::shared_ptr<const Snapshot> latest;
    std::stop_source stop; // stops work on the current generation
    bool failed = false;   // the render of this generation ended with an error
    std::string failure;   // its message
    int steps = 0;         // requested passes, regardless of pace and pause

    std::atomic<float> pass_progress = 0; // finished fraction of the current pass

    PaneReconstruction reconstruction;
    PaneRender own;    // render thread
    WarmSolver solver; // reconstruction thread

    void end_work() {
        stop.request_stop();
        stop = std::stop_source();
        reconstruction.end();
    }

    bool is_fresh() const { return own.generation != generation; } ///< its request has no Render yet
    bool lacks_preview() const { return is_fresh() && own.previews.is_first(generation); }

    bool is_at_limit(const Pace& pace) const {
        return !is_fresh() && pace.is_limit(own.render->spp(), own.render->seconds());
    }

    /// Returns whether there is a pass or a preview to render. A fresh pane renders previews even in pause.
    bool wants_pass(const Pace& pace, bool paused) const {
        if (generation == 0 || failed || !request.scene)
            return false;
        return steps > 0 || is_fresh() || (!paused && !is_at_limit(pace));
    }

    /// Makes a snapshot the latest, and returns the previous one. A snapshot without a reconstruction takes over
    /// that of the previous snapshot of the same render.
    std::shared_ptr<const Snapshot> take(const std::shared_ptr<Snapshot>& snapshot) {
        if (!snapshot->reconstruction && latest && latest->generation == snapshot->generation &&
            !latest->coarse()) {
            snapshot->reconstruction = latest->reconstruction;
            snapshot->reconstructed_with = latest->reconstructed_with;
            snapshot->reconstruction_spp = latest->reconstruction_spp;
            snapshot->reconstruction_seconds = latest->reconstruction_seconds;
        }
        return std::exchange(latest, snapshot);
    }

    /// Returns whether no newer snapshot follows the latest one. Such a picture is measured and saved, so it must
    /// depend on its samples only.
    bool rests(const Pace& pace, bool paused) const {
        return !latest->coarse() && (paused || pace.is_limit(latest->spp, latest->seconds));
    }

    /// Returns whether the latest snapshot needs a reconstruction. Snapshots of replaced requests do not, except
    /// previews.
    bool needs_reconstruction(const Pace& pace, bool paused) const {
        if (!latest || latest->images == reconstruction.given_up.lock() ||
            !(latest->coarse() || latest->generation == generation))
            return false;
        const bool is_new =
            latest->images != reconstruction.made_from || !(reconstruction.made_with == reconstruction.settings);
        return is_new || (rests(pace, paused) && latest->reconstruction && latest->reconstruction->goes_on &&
                          latest->images != reconstruction.renewed.lock());
    }
};

} // namespace tessera
