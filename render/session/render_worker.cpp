#include "render/session/render_worker.h"

#include "render/io/available_memory.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/core.h>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto publish_interval = std::chrono::milliseconds(200);
constexpr double preview_period = 1 / 15.0; // seconds for the first previews of all panes; not tuned

std::shared_ptr<Snapshot> snapshot_of(const Render& render, std::uint64_t generation, int divisor) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->generation = generation;
    snapshot->divisor = divisor;
    snapshot->spp = render.spp();
    snapshot->seconds = render.seconds();
    snapshot->cpu_seconds = render.cpu_seconds();
    snapshot->settings = render.settings();
    snapshot->scene = render.scene();
    snapshot->camera = render.camera();
    snapshot->learned = render.newest_learned();
    snapshot->counters = render.counters();
    snapshot->images = std::make_shared<GradientImages>(render.images());
    if (ReuseMaps maps = render.reuse_maps(); !maps.empty())
        snapshot->reuse = std::make_shared<ReuseMaps>(std::move(maps));
    return snapshot;
}

} // namespace

RenderWorker::RenderWorker(SessionState& shared, int threads)
    : shared_(shared), pool_(threads, ThreadPool::Priority::background),
      thread_([this](std::stop_token stop) { loop(stop); }) {}

// --- the turns ---

/// Returns the pane whose turn it is, or null if no pane has work. Panes without a preview of their request come
/// first, then panes with previews only, and in both groups those with the oldest turn. The others follow by the
/// time or samples that they have had, so that a pane that began later catches up. Needs the lock.
SessionPane* RenderWorker::next_pane() {
    SessionPane* next = nullptr;
    const auto order = [&](const SessionPane& p) {
        const double amount = p.is_fresh()                             ? 0
                              : shared_.pace.equal == Pace::Equal::spp ? p.own.render->spp()
                                                                       : p.own.render->seconds();
        return std::tuple(!p.lacks_preview(), !p.is_fresh(), amount, p.own.served);
    };
    for (const auto& pane : shared_.panes) {
        if (pane->wants_pass(shared_.pace, shared_.paused) && (!next || order(*pane) < order(*next)))
            next = pane.get();
    }
    if (next)
        next->own.served = ++turn_;
    return next;
}

/// Takes the render of a withdrawn pane, or returns null. Needs the lock.
std::unique_ptr<Render> RenderWorker::withdrawn_render() {
    for (const auto& pane : shared_.panes)
        if (pane->own.render && !pane->request.scene)
            return std::move(pane->own.render);
    return nullptr;
}

/// Returns a resting pane with unpublished passes, or null. Needs the lock.
SessionPane* RenderWorker::unpublished_pane() {
    for (const auto& pane : shared_.panes)
        if (!pane->wants_pass(shared_.pace, shared_.paused) && !pane->is_fresh() &&
            pane->own.has_unpublished_passes())
            return pane.get();
    return nullptr;
}

void RenderWorker::loop(std::stop_token stop) {
    lower_priority();
    while (!stop.stop_requested()) { // wait() returns true while there is work, even after a stop request
        SessionPane* to_render = nullptr;
        SessionPane* to_publish = nullptr;
        std::unique_ptr<Render> to_free;
        {
            std::unique_lock lock(shared_.mutex);
            const auto has_work = [&] {
                return (to_free = withdrawn_render()) || (to_publish = unpublished_pane()) ||
                       (to_render = next_pane());
            };
            if (!shared_.render_wake.wait(lock, stop, has_work))
                return;
        }
        if (to_render)
            step(*to_render, stop);
        if (to_publish)
            publish_passes(*to_publish);
    }
}

/// Renders one pass of a pane, or one preview before the first.
/// @param worker_stop  stops a first preview, which newer requests do not stop
void RenderWorker::step(SessionPane& pane, std::stop_token worker_stop) {
    RenderRequest request;
    std::uint64_t generation;
    std::stop_token stop;
    {
        const std::lock_guard lock(shared_.mutex);
        request = pane.request;
        generation = pane.generation;
        stop = pane.stop.get_token();
    }
    if (!request.scene)
        return; // withdrawn in between
    try {
        render_step(pane, request, generation, stop, worker_stop);
    } catch (const std::exception& error) {
        pane.own.generation = 0;
        give_up(pane, generation, message_of(error));
        shared_.report(fmt::format("{}, seed {}: {}", short_name(request.settings.method), request.settings.seed,
                                   message_of(error)));
    }
}

void RenderWorker::render_step(SessionPane& pane, const RenderRequest& request, std::uint64_t generation,
                               std::stop_token stop, std::stop_token worker_stop) {
    PaneRender& own = pane.own;
    if (own.generation != generation) {
        own.render.reset(); // before the next one takes memory
        if (own.previews.divisor(generation, request.size) > 0) {
            // A newer request does not stop a first preview. While a camera is dragged, each frame makes a
            // request, and a late picture is better than none.
            preview(pane, request, generation, own.previews.is_first(generation) ? worker_stop : stop);
            return; // other panes are next
        }
        own.render = std::make_unique<Render>(request.scene, request.camera, request.size, request.settings);
        own.generation = generation;
        own.published_spp = 0;
        return; // previews of other panes come first, and the session may be paused
    }
    if (!own.render->pass(pool_, stop, &pane.pass_progress))
        return;
    count_step(pane, generation);
    if (own.published_spp == 0 || Clock::now() - own.published_at >= publish_interval)
        publish_passes(pane);
}

/// Lets the pane rest until its next request, after an error.
void RenderWorker::give_up(SessionPane& pane, std::uint64_t generation, const std::string& why) {
    const std::lock_guard lock(shared_.mutex);
    if (pane.generation != generation)
        return;
    pane.failed = true;
    pane.failure = why;
}

/// Counts down the requested steps.
void RenderWorker::count_step(SessionPane& pane, std::uint64_t generation) {
    const std::lock_guard lock(shared_.mutex);
    if (pane.generation == generation && pane.steps > 0)
        --pane.steps;
}

// --- previews and snapshots ---

/// Renders a preview: one sample per pixel of a small image. Reconstructs it on this thread, because the
/// reconstruction thread could be slower than the next preview.
void RenderWorker::preview(SessionPane& pane, const RenderRequest& request, std::uint64_t generation,
                           std::stop_token stop) {
    const Clock::time_point start = Clock::now();
    const int divisor = pane.own.previews.divisor(generation, request.size);
    const glm::ivec2 size = (request.size + divisor - 1) / divisor;
    RenderSettings settings = request.settings;
    settings.path_guiding = Guiding::off; // a single pass does not benefit
    Render coarse(request.scene, request.camera, size, settings);
    if (!coarse.pass(pool_, stop, &pane.pass_progress))
        return;
    const auto snapshot = snapshot_of(coarse, generation, divisor);
    snapshot->settings = request.settings;
    snapshot->reconstructed_with = shared_.possible_reconstruction(pane);
    auto made = std::make_shared<Reconstruction>(
        reconstruct(*snapshot->images, snapshot->reconstructed_with, pool_.row_loops(), stop));
    if (made->image.empty())
        return; // stopped
    snapshot->reconstruction = std::move(made);
    snapshot->reconstruction_spp = snapshot->spp;
    snapshot->reconstruction_seconds = snapshot->seconds;
    publish(pane, snapshot);
    pane.pass_progress = 0; // the pass has not begun
    pane.own.previews.count(generation, divisor, std::chrono::duration<double>(Clock::now() - start).count(),
                            preview_budget());
}

/// Returns the seconds that a pane's first preview may take if all panes need one within preview_period. Takes the
/// lock.
double RenderWorker::preview_budget() const {
    const std::lock_guard lock(shared_.mutex);
    const auto in_use = std::count_if(shared_.panes.begin(), shared_.panes.end(),
                                      [](const auto& pane) { return pane->request.scene != nullptr; });
    return preview_period / static_cast<double>(std::max(in_use, std::ptrdiff_t{1}));
}

/// Gives the pane's latest snapshot to its followers, without its reconstruction. Needs the lock.
void RenderWorker::publish_to_followers(const SessionPane& pane) {
    for (const auto& other : shared_.panes) {
        if (other->followed < 0 || shared_.panes[other->followed].get() != &pane ||
            (other->generation != pane.latest->generation && !pane.latest->coarse()))
            continue;
        auto copy = std::make_shared<Snapshot>(*pane.latest);
        copy->reconstruction.reset();
        other->take(copy);
    }
}

/// Makes the snapshot the pane's latest.
void RenderWorker::publish(SessionPane& pane, const std::shared_ptr<Snapshot>& snapshot) {
    std::shared_ptr<const Snapshot> latest = snapshot; // becomes the previous one, which is freed without the lock
    std::shared_ptr<const GradientImages> reconstructed;
    {
        const std::lock_guard lock(shared_.mutex);
        if (!pane.request.scene || (pane.generation != snapshot->generation && !snapshot->coarse()))
            return;
        if (snapshot->reconstruction) {
            reconstructed = std::exchange(pane.reconstruction.made_from, snapshot->images);
            pane.reconstruction.made_with = snapshot->reconstructed_with;
        }
        latest = pane.take(snapshot);
        publish_to_followers(pane);
    }
    shared_.tell(); // first, because the reconstruction thread can take this core
    shared_.reconstruct_wake.notify_one();
}

/// Publishes the pane's passes. Reports a failure, such as missing memory for a copy. A later pass tries again,
/// and the render continues.
void RenderWorker::publish_passes(SessionPane& pane) {
    try {
        publish(pane, snapshot_of(*pane.own.render, pane.own.generation, 1));
    } catch (const std::exception& error) {
        shared_.report(fmt::format("pass {} is not shown: {}", pane.own.render->spp(), message_of(error)));
    }
    pane.own.published_spp = pane.own.render->spp();
    pane.own.published_at = Clock::now();
}

} // namespace tessera
