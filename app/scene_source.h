#pragma once

#include "render/load/scene_source.h"
#include "render/session/thread_pool.h"

#include <memory>
#include <vector>

namespace tessera {

/// A scene ready to render and how it came to be so.
struct OpenedScene {
    std::shared_ptr<const Scene> scene;
    std::vector<LoadNote> notes;
    double parse_seconds = 0; ///< wall time, as all of these
    double file_seconds = 0;
    double bvh_seconds = 0;
    double load_cpu_seconds = 0; ///< process CPU time of all but the BVH
    double bvh_cpu_seconds = 0;
};

/// Throws BadInput that names the file where there is none.
void check_scene_file(const std::filesystem::path& file);

/// Throws LoadError or another std::exception whose what() is fit for the user. `progress` may be null.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress);
/// The same, telling on a terminal how far it is.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool);

} // namespace tessera
