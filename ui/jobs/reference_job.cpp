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

/// Collects the progress of a reference render for the UI.
class ReferenceJob::Watch {
public:
    Watch(ReferenceProgress start, std::function<void()> wake)
        : progress_(std::move(start)), wake_(std::move(wake)) {}

    ReferenceProgress progress() const {
        const std::lock_guard lock(mutex_);
        return progress_;
    }

    /// Updates the progress. To be called before each pass. Returns whether the render continues.
    bool report(const ReferenceRender& render, const std::stop_token& stop) {
        const bool goes_on = !stop.stop_requested();
        std::optional<FloorFreeError> error;
        if (goes_on && is_measurement_due(render))
            error = measure(render);
        {
            const std::lock_guard lock(mutex_);
            progress_.spp = render.spp();
            progress_.spp_resumed = render.spp_resumed();
            progress_.seconds_left = render.seconds_left();
            if (error)
                progress_.error = error;
        }
        if (wake_ && (error || seconds_since(last_wake_) > 0.2)) {
            last_wake_ = Clock::now();
            wake_();
        }
        return goes_on;
    }

private:
    /// Limits measurements to about a twentieth of the time and to one per second.
    bool is_measurement_due(const ReferenceRender& render) const {
        return render.spp() >= 2 && seconds_since(last_measured_) >= std::max(1.0, 20 * measure_seconds_);
    }
    FloorFreeError measure(const ReferenceRender& render) {
        const auto start = Clock::now();
        const FloorFreeError error = render.error_so_far();
        last_measured_ = Clock::now();
        measure_seconds_ = seconds_since(start);
        return error;
    }

    mutable std::mutex mutex_;
    ReferenceProgress progress_; // guarded by mutex_
    std::function<void()> wake_;
    // Used by the thread of the render only.
    Clock::time_point last_wake_, last_measured_;
    double measure_seconds_ = 0;
};

void ReferenceJob::update(ViewerState& state, int threads, const std::function<void()>& wake) {
    ReferenceMaking& making = state.reference_making;
    if (std::exchange(state.wishes.make_reference, false) && !job_.running() && state.scene)
        start(state, threads, wake);
    if (std::exchange(state.wishes.stop_making, false))
        job_.stop();
    if (const auto outcome = job_.take()) {
        take(state, *outcome);
        job_.cancel(); // drops the request, which would keep the scene alive
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
    recipe.settings.filter = state.active().settings.render.filter;
    recipe.size = state.request_size();
    recipe.spp = making.spp;
    recipe.checkpoint_seconds = 30;
    ReferenceProgress progress;
    progress.file = file;
    progress.spp_wanted = recipe.spp;
    progress.seconds_left = std::numeric_limits<double>::infinity();
    const MakingRequest request{file, state.scene, state.camera.camera(), recipe.size,
                                std::make_shared<Watch>(progress, wake)};
    const PictureSubject subject{state.scene_info.source, request.scene, request.camera};
    job_.start(
        request,
        [=, watch = request.watch,
         anew = std::exchange(making.anew, false)](std::stop_token stop) -> MakingResult {
            lower_priority_further(); // the pool's threads inherit this priority
            check_writable(file);
            if (anew)
                std::filesystem::remove(reference_checkpoint(file));
            ThreadPool pool(threads);
            ReferenceRender render(file, subject, recipe, pool);
            const bool is_complete =
                render.run([&](const ReferenceRender& r) { return watch->report(r, stop); }, stop);
            MakingResult result{{}, render.spp(), {}};
            for (const Render& half : render.halves())
                result.halves.push_back({half.settings(), half.counters()});
            if (is_complete)
                result.error = error_of(render.finish());
            return result;
        },
        wake);
}

void ReferenceJob::take(ViewerState& state, const Job::Outcome& outcome) {
    const MakingRequest& request = outcome.request;
    const std::string file = request.file.string();
    if (!outcome.result)
        return state.add_message(Message::Kind::error,
                                 "Rendering the reference " + file + " has failed: " + outcome.error);
    const MakingResult& result = *outcome.result;
    for (const HalfCounters& half : result.halves)
        state.add_invalid("The reference", half.counters, state.active().slot,
                          {request.scene, request.camera, request.size, half.settings});
    if (!result.error)
        return state.add_message(
            Message::Kind::note,
            fmt::format("The reference was stopped at {} spp; its next render continues from {}", result.spp,
                        reference_checkpoint(file).string()));
    const bool is_on_show = request.scene == state.scene && request.camera == state.camera.camera() &&
                            request.size == state.request_size();
    state.add_message(Message::Kind::note,
                      fmt::format("Saved the reference, {} spp, to {}; its own relMSE is {:.3g} +- {:.2g}{}",
                                  result.spp, file, result.error->relative_mse, result.error->standard_error,
                                  is_on_show ? "" : ". It is not opened, because the panes show another view"));
    state.reference_making.show = false;
    if (is_on_show)
        state.wishes.open_reference = file;
}

} // namespace tessera
