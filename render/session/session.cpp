#include "render/session/session.h"

#include "render/session/reconstruction_worker.h"
#include "render/session/render_worker.h"
#include "render/session/session_state.h"

#include <chrono>
#include <mutex>
#include <utility>

namespace tessera {

Session::Session(int panes, int threads, std::function<void()> on_publish)
    : shared_(std::make_unique<SessionState>()) {
    shared_->on_publish = std::move(on_publish);
    for (int i = 0; i < panes; ++i)
        shared_->panes.push_back(std::make_unique<SessionPane>());
    render_ = std::make_unique<RenderWorker>(*shared_, threads);
    reconstruct_ = std::make_unique<ReconstructionWorker>(*shared_);
}

Session::~Session() {
    {
        const std::lock_guard lock(shared_->mutex);
        // Unlike end_work(), this keeps the stop sources, so a worker that takes a token later finds it stopped.
        for (const auto& pane : shared_->panes) {
            pane->stop.request_stop();
            pane->reconstruction.stop.request_stop();
        }
    }
    render_->request_stop(); // both stop in parallel; the destructors wait
    reconstruct_->request_stop();
}

SessionPane& Session::pane(int index) const {
    return *shared_->panes[index];
}

std::uint64_t Session::submit(int pane_index, RenderRequest request) {
    std::uint64_t generation;
    {
        const std::lock_guard lock(shared_->mutex);
        SessionPane& pane = this->pane(pane_index);
        pane.end_work();
        std::swap(pane.request, request);
        pane.followed = -1;
        pane.generation = generation = ++shared_->generation;
        pane.failed = false;
        pane.failure.clear();
        pane.pass_progress = 0;
        pane.steps = 0;
    }
    shared_->render_wake.notify_one();
    return generation;
}

std::uint64_t Session::follow(int pane_index, int other_index) {
    RenderRequest request; // large objects are freed without the lock
    std::shared_ptr<const Snapshot> latest;
    std::uint64_t generation;
    {
        const std::lock_guard lock(shared_->mutex);
        SessionPane& pane = this->pane(pane_index);
        const SessionPane& other = this->pane(other_index);
        pane.end_work();
        std::swap(pane.request, request);
        pane.followed = other_index;
        pane.generation = generation = other.generation;
        if (other.latest && other.latest->generation == generation) {
            auto copy = std::make_shared<Snapshot>(*other.latest);
            copy->reconstruction.reset();
            latest = pane.take(copy);
        }
    }
    shared_->render_wake.notify_one(); // frees the pane's own render
    shared_->reconstruct_wake.notify_one();
    return generation;
}

void Session::withdraw(int pane_index) {
    RenderRequest request; // large objects are freed without the lock, here and below
    std::shared_ptr<const Snapshot> latest;
    std::shared_ptr<const GradientImages> reconstructed;
    {
        const std::lock_guard lock(shared_->mutex);
        SessionPane& pane = this->pane(pane_index);
        pane.end_work();
        std::swap(pane.request, request);
        std::swap(pane.latest, latest);
        std::swap(pane.reconstruction.made_from, reconstructed);
        pane.followed = -1;
        pane.generation = ++shared_->generation; // drops the work on the old request
    }
    shared_->render_wake.notify_one();
}

void Session::set_reconstruction(int pane_index, const ReconstructionSettings& settings) {
    {
        const std::lock_guard lock(shared_->mutex);
        PaneReconstruction& own = pane(pane_index).reconstruction;
        if (!(own.settings == settings)) {
            own.end();
            own.given_up.reset();
        }
        own.settings = settings;
    }
    shared_->reconstruct_wake.notify_one();
}

std::optional<RunningReconstruction> Session::reconstructing(int pane_index) const {
    const std::lock_guard lock(shared_->mutex);
    const PaneReconstruction& own = pane(pane_index).reconstruction;
    if (own.spp == 0)
        return std::nullopt;
    const auto elapsed = std::chrono::steady_clock::now() - own.since;
    return RunningReconstruction{own.spp, std::chrono::duration<double>(elapsed).count(), own.share};
}

void Session::stop_reconstruction(int pane_index) {
    const std::lock_guard lock(shared_->mutex);
    SessionPane& pane = this->pane(pane_index);
    if (pane.reconstruction.spp == 0 || !pane.latest)
        return;
    pane.reconstruction.end();
    pane.reconstruction.given_up = pane.latest->images;
}

void Session::set_paused(bool paused) {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->paused = paused;
        if (!paused)
            for (const auto& pane : shared_->panes)
                pane->steps = 0;
    }
    shared_->render_wake.notify_one();
    shared_->reconstruct_wake.notify_one();
}

void Session::set_pace(const Pace& pace) {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->pace = pace;
    }
    shared_->render_wake.notify_one();
    shared_->reconstruct_wake.notify_one();
}

void Session::step() {
    {
        const std::lock_guard lock(shared_->mutex);
        for (const auto& pane : shared_->panes)
            ++pane->steps;
    }
    shared_->render_wake.notify_one();
}

bool Session::paused() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->paused;
}

std::shared_ptr<const Snapshot> Session::latest(int pane) const {
    const std::lock_guard lock(shared_->mutex);
    return this->pane(pane).latest;
}

bool Session::has_failed(int pane) const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->rendering(pane).failed;
}

std::string Session::failure(int pane) const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->rendering(pane).failure;
}

float Session::pass_progress(int pane) const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->rendering(pane).pass_progress;
}

std::vector<std::string> Session::take_messages() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->messages, {});
}

} // namespace tessera
