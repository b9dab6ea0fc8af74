#pragma once

#include "render/run/render.h"
#include "render/session/session.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include <glm/vec2.hpp>

namespace tessera {

/// How coarse the previews are that a pane has before its render: the first is there soon enough to follow a
/// camera that moves, on slow machines as well; where the camera rests, finer ones follow. A preview has one pixel
/// for divisor x divisor of the picture's.
class Previews {
public:
    static constexpr int finest = 4, coarsest = 16;
    static constexpr int most_pixels = 400'000; ///< of a first preview, as long as it can be coarser
    static constexpr int least_edge = 40; ///< pixels that a preview coarser than the finest has along either edge

    /// The divisor of the next preview of a request for a picture of that size; 0: there have been enough.
    int divisor(std::uint64_t generation, glm::ivec2 size) const {
        if (!is_first(generation))
            return next_;
        int divisor = first_;
        while (divisor < coarsest && size.x / divisor > most_pixels / std::max(size.y / divisor, 1))
            divisor *= 2;
        while (divisor > finest && std::min(size.x, size.y) < divisor * least_edge)
            divisor /= 2;
        return divisor;
    }
    /// Whether the request has had no preview yet.
    bool is_first(std::uint64_t generation) const { return generation != generation_; }

    /// Takes down that a preview with this divisor has been made in so many seconds.
    /// @param budget  seconds that the first preview of a request may take
    void count(std::uint64_t generation, int divisor, double seconds, double budget) {
        adapt(divisor, seconds, budget);
        generation_ = generation;
        next_ = divisor > finest ? divisor / 2 : 0;
    }

private:
    /// Sets the divisor of the next request's first preview. Half the divisor takes at most four times as long;
    /// margins keep it from going back and forth.
    void adapt(int divisor, double seconds, double budget) {
        constexpr double margin = 1.5;
        if (divisor < first_ && margin * seconds < budget)
            first_ = divisor; // one that followed was soon enough
        for (; divisor == first_ && seconds > budget && first_ < coarsest; seconds /= 4)
            divisor = first_ *= 2;
        if (divisor == first_ && 4 * margin * seconds < budget)
            first_ = std::max(first_ / 2, finest);
    }

    int first_ = finest;           // divisor of a request's first preview
    int next_ = 0;                 // divisor of the next preview of generation_
    std::uint64_t generation_ = 0; // the last that had a preview
};

struct Session::Pane {
    // Guarded by Session::mutex_.
    RenderRequest request;
    std::uint64_t generation = 0; // 0: nothing asked for yet
    int followed = -1;            // the pane whose passes it shows, without a request of its own; -1: none
    ReconstructionSettings reconstruction;
    std::shared_ptr<const Snapshot> latest;
    std::stop_source stop;       // ends work on the present generation
    std::stop_source solve_stop; // ends its reconstruction with the present settings
    bool failed = false;         // nothing more to do for this generation
    std::string failure;         // why
    int steps = 0;               // passes to do whatever the pace says

    // What the newest reconstruction was made from.
    std::shared_ptr<const GradientImages> reconstructed;
    ReconstructionSettings reconstructed_with;
    int solving_spp = 0; // of the snapshot that is being reconstructed; 0: none is
    std::chrono::steady_clock::time_point solving_since;
    std::atomic<float> solving_share = 0;         // of its steps; needs no lock
    std::weak_ptr<const GradientImages> given_up; // nothing is to be made from these
    std::weak_ptr<const GradientImages> renewed;  // their picture was made from nothing, or could not be

    std::atomic<float> pass_share = 0; // of its blocks that are done; needs no lock

    // Used by the render thread alone.
    Previews previews;
    std::unique_ptr<Render> render;
    std::uint64_t render_generation = 0;
    int published_spp = 0;
    std::chrono::steady_clock::time_point published_at;
    std::uint64_t served = 0; ///< turn in which it was last chosen

    void end_solve() {
        solve_stop.request_stop();
        solve_stop = std::stop_source();
    }
    void end_work() {
        stop.request_stop();
        stop = std::stop_source();
        end_solve();
    }

    bool is_fresh() const { return render_generation != generation; } ///< nothing of its request is rendered yet
    bool lacks_preview() const { return is_fresh() && previews.is_first(generation); }

    bool is_at_limit(const Pace& pace) const {
        return !is_fresh() && pace.is_limit(render->spp(), render->seconds());
    }

    /// Whether there is a pass to do.
    bool wants_pass(const Pace& pace, bool paused) const {
        if (generation == 0 || failed || !request.scene)
            return false;
        return steps > 0 || is_fresh() ||
               (!paused && !is_at_limit(pace)); // a first preview is there, paused or not
    }

    bool has_unseen_passes() const { return render && !is_fresh() && published_spp < render->spp(); }

    /// Takes a snapshot of passes. One without a reconstruction gets that of the same render's snapshot before,
    /// until there is a newer one. Returns what was there before.
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

    // Used by the reconstruction thread alone: where the solver stands, and with what.
    Reconstructor reconstructor;
    std::uint64_t solved_generation = 0;
    int solved_divisor = 0;
    ReconstructionSettings solved_with;

    /// Whether no samples are to come after the newest snapshot's: its picture is looked at, measured and saved,
    /// and is to hang on nothing but its samples.
    bool rests(const Pace& pace, bool paused) const {
        return !latest->coarse() && (paused || pace.is_limit(latest->spp, latest->seconds));
    }

    /// Whether the newest snapshot is to be reconstructed. Of a request that has been replaced, only a preview is
    /// worth it.
    bool needs_reconstruction(const Pace& pace, bool paused) const {
        if (!latest || latest->images == given_up.lock() ||
            !(latest->coarse() || latest->generation == generation))
            return false;
        const bool is_new = latest->images != reconstructed || !(reconstructed_with == reconstruction);
        return is_new || (rests(pace, paused) && latest->reconstruction && latest->reconstruction->goes_on &&
                          latest->images != renewed.lock());
    }

    /// Starts warm from the last snapshot of the same render, and else anew.
    Reconstructor& solver_for(const Snapshot& snapshot, const ReconstructionSettings& settings, bool anew) {
        if (anew || solved_generation != snapshot.generation || solved_divisor != snapshot.divisor ||
            solved_with != settings)
            reconstructor.forget();
        solved_generation = snapshot.generation;
        solved_divisor = snapshot.divisor;
        solved_with = settings;
        return reconstructor;
    }
};

} // namespace tessera
