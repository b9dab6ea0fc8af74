#pragma once

#include "render/io/files.h"
#include "render/io/text.h"
#include "render/load/scene_source.h"
#include "render/run/thread_pool.h"
#include "ui/jobs/scene_load.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// A line for each text: "file:line:column: text", with the places of further notes of the same text behind it, of
/// which some are named and the others counted. Errors first, otherwise in order of the first places.
SceneNotes group_notes(const std::vector<LoadNote>& notes);
/// Writes them to stderr, as errors and notes.
void print_notes(const std::vector<LoadNote>& notes);

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

/// Loads and builds a scene. Throws LoadError or another std::exception whose what() is fit for the user.
/// `progress` may be null.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool, LoadProgress* progress);
/// Does the same, and tells on a terminal how far it is.
OpenedScene open_scene(const SceneSource& source, ThreadPool& pool);

/// Makes the scene of `source`, with `threads` threads as in ThreadPool, whenever it is called: in the background,
/// the calling thread included, so that what draws comes first.
SceneLoader loader_of(const SceneSource& source, int threads);
/// The scene of `source` as the viewer loads it, by loader_of.
SceneOrigin origin_of(const SceneSource& source, int threads);

/// An option or argument that names a file, as it was given.
struct NamedFile {
    std::string option;
    std::filesystem::path file; ///< empty: not given
};

/// Throws BadInput where an output is the same file as another, or as one that is read: one would replace the
/// other. Devices and pipes may be named as often as one likes.
void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Makes the folder and those that it lies in, where there are none. Throws BadInput.
void make_folder(const std::filesystem::path& folder);

} // namespace tessera
