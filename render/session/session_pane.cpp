#include "render/session/session_pane.h"

#include "recon/picture/oidn.h"
#include "render/io/available_memory.h"
#include "render/run/fitting_reconstruction.h"
#include "render/run/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <utility>

#include <fmt/core.h>

namespace tessera {

// The first two functions make what a pane shows at once, before its render begins.

namespace {

using Clock = std::chrono::steady_clock;
constexpr double preview_period = 1 / 15.0; // seconds for a first preview of each pane, while a camera moves

} // namespace

/// Renders a preview: one sample a pixel of a small image. It is reconstructed before it is shown, as the next may
/// be there before another thread had done so.
void Session::preview(Pane& pane, const RenderRequest& request, std::uint64_t generation, std::stop_token stop) {
    const Clock::time_point start = Clock::now();
    const int divisor = pane.previews.divisor(generation, request.size);
    const glm::ivec2 size = (request.size + divisor - 1) / divisor;
    RenderSettings settings = request.settings;
    settings.path_guiding = Guiding::off; // a first pass is not guided, and there is no second one to learn for
    Render coarse(request.scene, request.camera, size, settings);
    if (!coarse.pass(pool_, stop, &pane.pass_share))
        return;
    const auto snapshot = snapshot_of(coarse, generation, divisor);
    snapshot->settings = request.settings;
    snapshot->reconstructed_with = possible_reconstruction(pane);
    auto made = std::make_shared<Reconstruction>(
        reconstruct(*snapshot->images, snapshot->reconstructed_with, pool_.row_loops(), stop));
    if (made->image.empty())
        return; // stopped
    snapshot->reconstruction = std::move(made);
    snapshot->reconstruction_spp = snapshot->spp;
    snapshot->reconstruction_seconds = snapshot->seconds;
    publish(pane, snapshot);
    pane.pass_share = 0; // of its pass nothing is done
    pane.previews.count(generation, divisor, std::chrono::duration<double>(Clock::now() - start).count(),
                        preview_budget());
}

/// Seconds that a pane's first preview may take, so that all panes have one in time. Takes the lock.
double Session::preview_budget() const {
    const std::lock_guard lock(mutex_);
    const auto in_use = std::count_if(panes_.begin(), panes_.end(),
                                      [](const auto& pane) { return pane->request.scene != nullptr; });
    return preview_period / static_cast<double>(std::max(in_use, std::ptrdiff_t{1}));
}

// The next ones make snapshots of a session's passes.

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

/// Gives the pane's latest snapshot to those that show its passes, each of which reconstructs it anew. Needs the
/// lock.
void Session::hand_on(const Pane& pane) {
    for (const auto& other : panes_) {
        if (other->followed < 0 || panes_[static_cast<std::size_t>(other->followed)].get() != &pane ||
            (other->generation != pane.latest->generation && !pane.latest->coarse()))
            continue;
        auto copy = std::make_shared<Snapshot>(*pane.latest);
        copy->reconstruction.reset();
        other->take(copy);
    }
}

/// Makes the snapshot the pane's latest.
void Session::publish(Pane& pane, const std::shared_ptr<Snapshot>& snapshot) {
    std::shared_ptr<const Snapshot> latest = snapshot; // the one before takes its place, and goes without the lock
    std::shared_ptr<const GradientImages> reconstructed;
    {
        const std::lock_guard lock(mutex_);
        if (!pane.request.scene || (pane.generation != snapshot->generation && !snapshot->coarse()))
            return;
        if (snapshot->reconstruction) {
            reconstructed = std::exchange(pane.reconstructed, snapshot->images);
            pane.reconstructed_with = snapshot->reconstructed_with;
        }
        latest = pane.take(snapshot);
        hand_on(pane);
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
        messages_.push_back(fmt::format("the newest picture is not shown: {}", message_of(error)));
    }
}

/// Publishes the pane's passes up to now. What goes wrong (there is no memory for a copy) is told, and tried again
/// with later passes: the render itself has lost nothing.
void Session::publish_passes(Pane& pane) {
    try {
        publish(pane, snapshot_of(*pane.render, pane.render_generation, 1));
    } catch (const std::exception& error) {
        report(fmt::format("pass {} is not shown: {}", pane.render->spp(), message_of(error)));
    }
    pane.published_spp = pane.render->spp();
    pane.published_at = std::chrono::steady_clock::now();
}

/// The pane's settings, in which another norm takes the place of one that cannot be had here, with a message. To
/// be called by workers, without the lock: the first look for a library takes its time.
ReconstructionSettings Session::possible_reconstruction(Pane& pane) {
    ReconstructionSettings settings;
    {
        const std::lock_guard lock(mutex_);
        settings = pane.reconstruction;
    }
    const Norm norm = possible(settings.norm);
    if (norm == settings.norm)
        return settings;
    {
        const std::lock_guard lock(mutex_);
        if (pane.reconstruction == settings) { // not chosen anew meanwhile
            pane.reconstruction.norm = norm;
            messages_.push_back(oidn_problem() + "; the picture is that of guided");
        }
    }
    settings.norm = norm;
    return settings;
}

// The session's second thread makes pictures from primal and gradients, the newest snapshot first.

void Session::reconstruct_loop(std::stop_token stop) {
    work_in_background();
    std::size_t turn = 0; // panes in turn, so that none starves
    while (!stop.stop_requested()) {
        Pane* pane = nullptr;
        {
            std::unique_lock lock(mutex_);
            const auto find = [&] {
                for (std::size_t i = 0; i < panes_.size() && !pane; ++i) {
                    Pane* candidate = panes_[(turn + i) % panes_.size()].get();
                    if (candidate->needs_reconstruction(pace_, paused_))
                        pane = candidate;
                }
                return pane != nullptr;
            };
            if (!reconstruct_wake_.wait(lock, stop, find))
                return;
            ++turn;
        }
        const ReconstructionSettings settings = possible_reconstruction(*pane);
        std::shared_ptr<const Snapshot> snapshot;
        std::stop_token solve_stop;
        bool anew = false;
        {
            const std::lock_guard lock(mutex_);
            if (!pane->needs_reconstruction(pace_, paused_) || !(pane->reconstruction == settings))
                continue; // it has changed meanwhile
            snapshot = pane->latest;
            solve_stop = pane->solve_stop.get_token();
            pane->solving_spp = snapshot->spp;
            pane->solving_since = std::chrono::steady_clock::now();
            pane->solving_share = 0;
            anew = pane->rests(pace_, paused_);
            if (anew)
                pane->renewed = snapshot->images;
        }
        reconstruct_snapshot(*pane, *snapshot, settings, anew, solve_stop);
    }
}

void Session::reconstruct_snapshot(Pane& pane, const Snapshot& snapshot, const ReconstructionSettings& settings,
                                   bool anew, std::stop_token stop) {
    auto result = std::make_shared<Reconstruction>();
    std::shared_ptr<const GradientImages> reconstructed =
        snapshot.images; // those before take their place, and go without the lock
    std::shared_ptr<const Snapshot> latest;
    std::string failure;
    try {
        *result = reconstruct_if_it_fits(pane.solver_for(snapshot, settings, anew), *snapshot.images, settings,
                                         serial_for, 1, {stop, &pane.solving_share});
    } catch (const std::exception& error) {
        failure = fmt::format("reconstruction of pass {}: {}", snapshot.spp, message_of(error));
    }
    {
        const std::lock_guard lock(mutex_);
        pane.solving_spp = 0;
        // A newer picture of another size or request has no use for this one.
        if (stop.stop_requested() || pane.latest->generation != snapshot.generation ||
            pane.latest->divisor != snapshot.divisor)
            return;
        std::swap(pane.reconstructed, reconstructed);
        pane.reconstructed_with = settings;
        if (!failure.empty()) {
            messages_.push_back(std::move(failure));
        } else {
            // The render may have gone on meanwhile: the newest snapshot gets this picture, labelled with its
            // pass.
            auto updated = std::make_shared<Snapshot>(*pane.latest);
            updated->reconstruction = std::move(result);
            updated->reconstructed_with = settings;
            updated->reconstruction_spp = snapshot.spp;
            updated->reconstruction_seconds = snapshot.seconds;
            latest = std::exchange(pane.latest, std::move(updated));
        }
    }
    tell();
}

} // namespace tessera
