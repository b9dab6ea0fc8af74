#include "app/scene_loader.h"

#include "app/load_notes.h"
#include "app/scene_source.h"
#include "render/session/thread_priority.h"

namespace tessera {

SceneLoader loader_of(const SceneSource& source, int threads) {
    return [source, threads](std::vector<std::string>& notes, LoadProgress& progress) {
        work_in_background(); // and so will the threads that it starts, which take its priority
        ThreadPool pool(threads);
        const OpenedScene opened = open_scene(source, pool, &progress);
        notes = group_notes(opened.notes);
        return opened.scene;
    };
}

SceneOrigin origin_of(const SceneSource& source, int threads) {
    return {to_string(source), {source.file, source.variables, {}}, loader_of(source, threads)};
}

} // namespace tessera
