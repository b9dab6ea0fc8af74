#include "ui/scene_load.h"

#include <chrono>
#include <exception>

namespace tessera {

using Clock = std::chrono::steady_clock;

struct SceneLoad::Job {
    SceneOrigin origin;
    Clock::time_point start = Clock::now();
    LoadProgress progress;
    std::future<SceneLoadResult> result;
    std::jthread thread; // last: it uses the others until it ends

    bool ended() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
    SceneLoadResult load();
};

SceneLoadResult SceneLoad::Job::load() {
    SceneLoadResult loaded;
    loaded.origin = origin;
    try {
        loaded.scene = origin.loader(loaded.notes, progress);
        if (!loaded.scene)
            loaded.error = origin.name + ": no scene";
    } catch (const std::exception& e) {
        loaded.error = e.what();
    }
    loaded.seconds = seconds();
    return loaded;
}

SceneLoad::SceneLoad() = default;

SceneLoad::~SceneLoad() {
    if (job_)
        job_->progress.give_up();
}

void SceneLoad::cancel() {
    if (!job_)
        return;
    job_->progress.give_up();
    given_up_.push_back(std::move(job_));
}

void SceneLoad::start(SceneOrigin origin, std::function<void()> on_done) {
    cancel();
    job_ = std::make_unique<Job>();
    job_->origin = std::move(origin);
    std::promise<SceneLoadResult> promise;
    job_->result = promise.get_future();
    const auto run = [job = job_.get()](std::promise<SceneLoadResult> result, const std::function<void()>& done) {
        result.set_value(job->load());
        if (done)
            done();
    };
    job_->thread = std::jthread(run, std::move(promise), std::move(on_done));
}

const SceneOrigin& SceneLoad::origin() const {
    return job_->origin;
}
LoadProgress::State SceneLoad::progress() const {
    return job_->progress.state();
}
double SceneLoad::seconds() const {
    return job_->seconds();
}

std::optional<SceneLoadResult> SceneLoad::poll() {
    std::erase_if(given_up_, [](const auto& job) { return job->ended(); });
    if (!job_ || !job_->ended())
        return std::nullopt;
    SceneLoadResult result = job_->result.get();
    job_.reset();
    return result;
}

} // namespace tessera
