#include "render/io/files.h"
#include "render/run/reference_render.h"
#include "render/run/thread_pool.h"
#include "ui/jobs/jobs.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <stop_token>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

/// Looks at a render after every pass, and lets the UI know.
class ReferenceJob::Watch {
public:
    Watch(ReferenceProgress start, std::function<void()> wake)
        : progress_(std::move(start)), wake_(std::move(wake)) {}

    ReferenceProgress progress() const {
        const std::lock_guard lock(mutex_);
        return progress_;
    }

    /// Whether to go on.
    bool look(const ReferenceRender& render, const std::stop_token& stop) {
        const bool goes_on = !stop.stop_requested();
        std::optional<FloorFreeError> error;
        if (goes_on && is_time_to_measure(render))
            error = measure(render);
        {
            const std::lock_guard lock(mutex_);
            progress_.spp = render.spp();
            progress_.spp_resumed = render.spp_resumed();
            progress_.seconds_left = render.seconds_left();
            if (error)
                progress_.error = error;
        }
        if (wake_ && (error || seconds_since(woken_) > 0.2)) {
            woken_ = Clock::now();
            wake_();
        }
        return goes_on;
    }

private:
    /// Errors are to cost no more than a twentieth of the time.
    bool is_time_to_measure(const ReferenceRender& render) const {
        return render.spp() >= 2 && seconds_since(measured_) >= std::max(1.0, 20 * measuring_took_);
    }
    FloorFreeError measure(const ReferenceRender& render) {
        const auto start = Clock::now();
        const FloorFreeError error = render.error_so_far();
        measured_ = Clock::now();
        measuring_took_ = seconds_since(start);
        return error;
    }

    mutable std::mutex mutex_;
    ReferenceProgress progress_; // guarded by it
    std::function<void()> wake_;
    // Used by the render's thread alone.
    Clock::time_point woken_, measured_;
    double measuring_took_ = 0;
};

void ReferenceJob::update(ViewerState& state, int threads, const std::function<void()>& wake) {
    ReferenceMaking& making = state.reference_making;
    if (std::exchange(state.wishes.make_reference, false) && !job_.running() && state.scene)
        start(state, threads, wake);
    if (std::exchange(state.wishes.stop_making, false))
        job_.stop();
    if (const auto outcome = job_.take()) {
        take(state, *outcome);
        job_.cancel(); // its order would keep the scene
    }
    making.progress.reset();
    if (job_.running()) {
        making.progress = job_.asked()->watch->progress();
        making.progress->is_ending = job_.stopping();
    }
}

void ReferenceJob::start(ViewerState& state, int threads, const std::function<void()>& wake) {
    ReferenceMaking& making = state.reference_making;
    const std::filesystem::path file = wanted_reference_file(state);
    ReferenceRecipe recipe;
    recipe.settings.method = making.method;
    recipe.settings.max_depth = state.active().settings.render.max_depth;
    recipe.size = state.request_size();
    recipe.spp = making.spp;
    recipe.checkpoint_seconds = 30;
    ReferenceProgress progress;
    progress.file = file;
    progress.spp_wanted = recipe.spp;
    progress.seconds_left = std::numeric_limits<double>::infinity();
    const Order order{file, state.scene, state.camera.camera(), recipe.size,
                      std::make_shared<Watch>(progress, wake)};
    const PictureSubject subject{state.scene_info.source, order.scene, order.camera};
    job_.start(
        order,
        [=, watch = order.watch, anew = std::exchange(making.anew, false)](std::stop_token stop) -> Made {
            work_behind_others(); // and so do the pool's threads, which begin as their maker is
            check_writable(file);
            if (anew)
                std::filesystem::remove(reference_checkpoint(file));
            ThreadPool pool(threads);
            ReferenceRender render(file, subject, recipe, pool);
            const bool is_complete =
                render.run([&](const ReferenceRender& r) { return watch->look(r, stop); }, stop);
            Made made{{}, render.spp(), {}};
            for (const Render& half : render.halves())
                made.halves.push_back({half.settings(), half.counters()});
            if (is_complete)
                made.error = error_of(render.finish());
            return made;
        },
        wake);
}

void ReferenceJob::take(ViewerState& state, const Job::Outcome& outcome) {
    const Order& order = outcome.request;
    const std::string file = order.file.string();
    if (!outcome.result)
        return state.add_message(Message::Kind::error,
                                 "The reference " + file + " was not made: " + outcome.error);
    const Made& made = *outcome.result;
    for (const Counted& half : made.halves)
        state.add_refused("The reference", half.counters, state.active().slot,
                          {order.scene, order.camera, order.size, half.settings});
    if (!made.error)
        return state.add_message(Message::Kind::note,
                                 fmt::format("The reference has {} spp; made again, it goes on from {}", made.spp,
                                             reference_checkpoint(file).string()));
    const bool is_on_show =
        order.scene == state.scene && order.camera == state.camera.camera() && order.size == state.request_size();
    state.add_message(Message::Kind::note,
                      fmt::format("Saved the reference, {} spp, to {}; its own relMSE is {:.3g} +- {:.2g}{}",
                                  made.spp, file, made.error->relative_mse, made.error->standard_error,
                                  is_on_show ? "" : ". It is not opened: the panes show another view by now"));
    state.reference_making.show = false;
    if (is_on_show)
        state.wishes.open_reference = file;
}

} // namespace tessera
