#include "ui/scene_load.h"

#include <chrono>
#include <exception>

namespace tessera {

namespace {

SceneLoadResult load(const std::string& name, const SceneLoader& loader) {
    SceneLoadResult result;
    result.name = name;
    const auto start = std::chrono::steady_clock::now();
    try {
        result.scene = loader(result.notes);
        if (!result.scene)
            result.error = name + ": no scene";
    } catch (const std::exception& e) {
        result.error = e.what();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace

void SceneLoad::start(std::string name, SceneLoader loader, std::function<void()> on_done) {
    name_ = std::move(name);
    std::promise<SceneLoadResult> promise;
    result_ = promise.get_future();
    const auto run = [](std::promise<SceneLoadResult> result, const std::string& scene_name,
                        const SceneLoader& scene_loader, const std::function<void()>& done) {
        result.set_value(load(scene_name, scene_loader));
        if (done)
            done();
    };
    thread_ = std::jthread(run, std::move(promise), name_, std::move(loader), std::move(on_done));
}

std::optional<SceneLoadResult> SceneLoad::poll() {
    if (!running() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return result_.get();
}

} // namespace tessera
