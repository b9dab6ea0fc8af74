// How a session's passes become snapshots.
#include "render/session/session_pane.h"

#include <chrono>
#include <utility>

#include <fmt/core.h>

namespace tessera {

std::shared_ptr<Snapshot> Session::snapshot_of(const Render& render, std::uint64_t generation, int divisor) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->generation = generation;
    snapshot->divisor = divisor;
    snapshot->spp = render.spp();
    snapshot->seconds = render.seconds();
    snapshot->cpu_seconds = render.cpu_seconds();
    snapshot->settings = render.settings();
    snapshot->scene = render.scene();
    snapshot->camera = render.camera();
    snapshot->plan = render.newest_plan();
    snapshot->counters = render.counters();
    snapshot->images = std::make_shared<GradientImages>(render.images());
    if (ReuseMaps maps = render.reuse_maps(); !maps.empty())
        snapshot->reuse = std::make_shared<ReuseMaps>(std::move(maps));
    return snapshot;
}

/// One without a reconstruction gets that of the render's snapshot before, until there is a newer one.
void Session::publish(Pane& pane, const std::shared_ptr<Snapshot>& snapshot) {
    std::shared_ptr<const Snapshot> latest = snapshot; // and then the one before, given up without the lock
    std::shared_ptr<const GradientImages> reconstructed;
    {
        const std::lock_guard lock(mutex_);
        if (!pane.request.scene || (pane.generation != snapshot->generation && !snapshot->coarse()))
            return;
        if (snapshot->reconstruction) {
            reconstructed = std::exchange(pane.reconstructed, snapshot->images);
            pane.reconstructed_with = snapshot->reconstructed_with;
        } else if (pane.latest && pane.latest->generation == snapshot->generation && !pane.latest->coarse()) {
            snapshot->reconstruction = pane.latest->reconstruction;
            snapshot->reconstructed_with = pane.latest->reconstructed_with;
            snapshot->reconstruction_spp = pane.latest->reconstruction_spp;
            snapshot->reconstruction_seconds = pane.latest->reconstruction_seconds;
        }
        std::swap(pane.latest, latest);
    }
    tell(); // first: the other thread may take this one's core
    reconstruct_wake_.notify_one();
}

/// Calls on_publish. It is not to end a thread of the session, whatever goes wrong there.
void Session::tell() {
    try {
        if (on_publish_)
            on_publish_();
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        messages_.push_back(fmt::format("the newest picture is not shown: {}", error.what()));
    }
}

/// The pane's passes up to now. What goes wrong (there is no memory for a copy) is told, and tried again with
/// later passes: the render itself has lost nothing.
void Session::publish_passes(Pane& pane) {
    try {
        publish(pane, snapshot_of(*pane.render, pane.render_generation, 1));
    } catch (const std::exception& error) {
        report(fmt::format("pass {} is not shown: {}", pane.render->spp(), error.what()));
    }
    pane.published_spp = pane.render->spp();
    pane.published_at = std::chrono::steady_clock::now();
}

} // namespace tessera
