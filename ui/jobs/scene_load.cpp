#include "ui/jobs/scene_load.h"

#include <exception>
#include <utility>

namespace tessera {

namespace {

SceneLoadResult load(const SceneOrigin& origin, LoadProgress& progress) {
    SceneLoadResult loaded;
    loaded.origin = origin;
    try {
        loaded.scene = origin.loader(loaded.notes, progress);
        if (!loaded.scene)
            loaded.error = origin.name + ": no scene";
    } catch (const std::exception& e) { // the notes until then are kept
        loaded.error = e.what();
    }
    return loaded;
}

} // namespace

void SceneLoad::cancel() {
    if (progress_)
        progress_->give_up();
    job_.cancel();
}

void SceneLoad::start(SceneOrigin origin, std::function<void()> on_done) {
    cancel();
    origin_ = std::move(origin);
    start_ = Clock::now();
    progress_ = std::make_shared<LoadProgress>();
    job_.start([origin = origin_, progress = progress_](std::stop_token) { return load(origin, *progress); },
               std::move(on_done));
}

double SceneLoad::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::optional<SceneLoadResult> SceneLoad::poll() {
    auto outcome = job_.poll();
    return outcome ? std::move(outcome->result) : std::nullopt;
}

} // namespace tessera
