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

/// The render of a pane. Used by the render thread alone.
struct PaneRender {
    Previews previews;
    std::unique_ptr<Render> render;
    std::uint64_t generation = 0; // of the request that it renders
    int published_spp = 0;
    std::chrono::steady_clock::time_point published_at;
    std::uint64_t served = 0; // turn in which the pane was last chosen

    bool has_unpublished_passes() const { return render && published_spp < render->spp(); }
};

/// The reconstruction of a pane: what is asked for, what is under way, and what is made. Guarded by
/// SessionState::mutex, except `share`.
struct PaneReconstruction {
    ReconstructionSettings settings;
    std::stop_source stop; // ends the one under way

    std::shared_ptr<const GradientImages> made_from; // of the newest one
    ReconstructionSettings made_with;                // of the newest one

    int spp = 0;                                 // of the snapshot under reconstruction; 0: none is
    std::chrono::steady_clock::time_point since; // start of the one under way
    std::atomic<float> share = 0;                // of its steps that are done

    std::weak_ptr<const GradientImages> given_up; // images that are not to be reconstructed
    std::weak_ptr<const GradientImages> renewed;  // images whose reconstruction started cold, or failed to

    void end() {
        stop.request_stop();
        stop = std::stop_source();
    }
};

/// Keeps the solver's state from one snapshot to the next. Used by the reconstruction thread alone.
class WarmSolver {
public:
    /// Returns the solver. It starts warm from the last snapshot if that was of the same render with the same
    /// settings, and cold otherwise.
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
    // Of the last snapshot.
    std::uint64_t generation_ = 0;
    int divisor_ = 0;
    ReconstructionSettings settings_;
};

/// A pane of a session. Guarded by SessionState::mutex, except `pass_share` and the parts of one thread.
struct SessionPane {
    RenderRequest request;
    std::uint64_t generation = 0; // of the request; 0: none yet
    int followed = -1;            // pane whose passes it shows, without a request of its own; -1: none
    std::shared_ptr<const Snapshot> latest;
    std::stop_source stop; // ends work on the present generation
    bool failed = false;   // nothing more is rendered for this generation
    std::string failure;   // why
    int steps = 0;         // passes to do whatever the pace says

    std::atomic<float> pass_share = 0; // of the blocks of the pass under way that are done

    PaneReconstruction reconstruction;
    PaneRender own;    // render thread
    WarmSolver solver; // reconstruction thread

    void end_work() {
        stop.request_stop();
        stop = std::stop_source();
        reconstruction.end();
    }

    bool is_fresh() const { return own.generation != generation; } ///< nothing of its request is rendered
    bool lacks_preview() const { return is_fresh() && own.previews.is_first(generation); }

    bool is_at_limit(const Pace& pace) const {
        return !is_fresh() && pace.is_limit(own.render->spp(), own.render->seconds());
    }

    /// Whether there is a pass or a preview to render. A fresh pane has its first preview even if it is paused.
    bool wants_pass(const Pace& pace, bool paused) const {
        if (generation == 0 || failed || !request.scene)
            return false;
        return steps > 0 || is_fresh() || (!paused && !is_at_limit(pace));
    }

    /// Takes a snapshot of passes, and returns the one before. A snapshot without a reconstruction gets that of
    /// the same render's snapshot before, until there is a newer one.
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

    /// Whether the newest snapshot is the last one. Its picture is measured and saved, and must depend on its
    /// samples only.
    bool rests(const Pace& pace, bool paused) const {
        return !latest->coarse() && (paused || pace.is_limit(latest->spp, latest->seconds));
    }

    /// Whether the newest snapshot is to be reconstructed. Snapshots of replaced requests are not, except
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
