#include "ui/jobs/scene_load.h"

#include "render/io/available_memory.h"

#include <exception>
#include <stop_token>
#include <system_error>
#include <utility>

namespace tessera {

namespace {

SceneLoadResult load_scene(const SceneOrigin& origin, LoadProgress& progress) {
    SceneLoadResult loaded;
    loaded.origin = origin;
    try {
        loaded.scene = origin.loader(loaded.notes, progress);
        if (!loaded.scene)
            loaded.error = origin.name + ": no scene";
    } catch (const std::exception& e) { // loaded.notes keeps the notes so far
        loaded.error = message_of(e);
    }
    return loaded;
}

} // namespace

bool is_same_scene(const SceneOrigin& a, const SceneOrigin& b) {
    std::error_code ignored;
    const std::filesystem::path &one = a.source.file, &other = b.source.file;
    return (a.name == b.name && one == other) ||
           (!one.empty() && !other.empty() && std::filesystem::equivalent(one, other, ignored));
}

void SceneLoad::start(SceneOrigin origin, std::function<void()> on_done) {
    const Load load{std::move(origin), std::make_shared<LoadProgress>(), Clock::now()};
    job_.start(
        load,
        [load](std::stop_token stop) {
            const std::stop_callback give_up(stop, [&] { load.progress->give_up(); });
            return load_scene(load.origin, *load.progress);
        },
        std::move(on_done));
}

double SceneLoad::seconds() const {
    return std::chrono::duration<double>(Clock::now() - job_.asked()->start).count();
}

std::optional<SceneLoadResult> SceneLoad::take() {
    auto outcome = job_.take();
    return outcome ? std::move(outcome->result) : std::nullopt;
}

} // namespace tessera
