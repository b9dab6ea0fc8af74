#pragma once

#include "render/load/mitsuba_xml.h"
#include "render/session/thread_pool.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace tessera {

/// Where a command takes its scene from.
struct SceneSource {
    std::filesystem::path file;        ///< empty: the Cornell box inside the program
    SceneVariables variables;          ///< -D name=value
    std::filesystem::path camera = {}; ///< a file with the camera to take; empty: the scene's own
};

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

/// Throws LoadError or another std::exception whose what() is fit for the user. `progress` may be null.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress);
/// The same, telling on a terminal how far it is.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool);

/// The name to show for it.
std::string to_string(const SceneSource& source);

} // namespace tessera
