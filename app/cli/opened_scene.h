#pragma once

#include "render/io/files.h"
#include "render/io/text.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/scene_source.h"
#include "render/run/thread_pool.h"
#include "render/scene/camera.h"
#include "ui/jobs/scene_load.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// Merges notes of equal text into one line "file:line:column: text (also at ...)", which lists the first few
/// further positions and counts the rest. Errors come first, then by first position.
SceneNotes group_notes(const std::vector<LoadNote>& notes);
/// Prints the notes to stderr as errors and notes.
void print_notes(const std::vector<LoadNote>& notes);

/// A scene ready to render, with notes and costs of loading it.
struct OpenedScene {
    std::shared_ptr<const Scene> scene;
    std::vector<LoadNote> notes;
    std::vector<MeshListing> meshes; ///< of mesh files
    double parse_seconds = 0;        ///< wall time, like the next two
    double file_seconds = 0;
    double bvh_seconds = 0;
    double load_cpu_seconds = 0; ///< process CPU time, without the BVH
    double bvh_cpu_seconds = 0;
};

/// Throws BadInput that names the file if it does not exist.
void check_scene_file(const std::filesystem::path& file);

/// Returns the camera. If it has no crop window or no filter of its own, it gets that of the scene's sensor.
Camera with_film_of(Camera camera, const Camera& sensor);

/// Loads and builds a scene. Throws LoadError or another std::exception whose what() is fit for the user.
/// `progress` may be null.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress);
/// Loads and builds a scene, with a progress bar on a terminal.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool);

/// Returns a loader of `source` that uses `threads` threads, as in ThreadPool. It runs at background priority,
/// the calling thread included, so that drawing has precedence.
SceneLoader loader_of(const SceneSource& source, int threads);
/// Returns the origin of `source` for the viewer, with loader_of as its loader.
SceneOrigin origin_of(const SceneSource& source, int threads);

/// A file name from the command line.
struct NamedFile {
    std::string option;
    std::filesystem::path file; ///< empty: not given
};

/// Throws BadInput if an output is the same file as another output or an input, as one would overwrite the other.
/// Devices and pipes may occur any number of times.
void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Creates the folder and its missing parents. Throws BadInput.
void make_folder(const std::filesystem::path& folder);

} // namespace tessera
