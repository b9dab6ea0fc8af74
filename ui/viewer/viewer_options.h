#pragma once

#include "render/load/scene_source.h"
#include "render/session/snapshot.h"
#include "ui/jobs/followed_folder.h"
#include "ui/jobs/scene_load.h"
#include "ui/state/companions.h"
#include "ui/state/document.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// A pane's picture, with the data that its EXR file describes.
struct SavedPicture {
    std::shared_ptr<const Snapshot> snapshot;
    ReconstructionSettings reconstruction;
    SceneSource source;                         ///< without a file: the scene is not in a file
    std::shared_ptr<const Scene> scene;         ///< for first hits; null: the scene has been replaced
    std::shared_ptr<const Reference> reference; ///< for errors; null: none is loaded
};

/// Writes a picture with its layers, camera and settings to an EXR file; called from a thread other than the
/// UI's. Throws std::exception, whose what() becomes a message.
using PictureWriter = std::function<void(const std::filesystem::path& file, const SavedPicture& picture)>;

/// Options of the command line, and the program's functions that the viewer calls.
struct ViewerOptions {
    std::vector<PaneSettings> panes; ///< initial settings of each pane; 1 to most_panes
    std::optional<int> max_depth;    ///< for all scenes; empty: each scene's own
    SizeChoice size;
    int spp_limit = 0;                   ///< samples per pixel at which panes stop; 0: no limit
    int threads = 0;                     ///< threads of reference renders; as in ThreadPool
    std::optional<SampleChoice> sample;  ///< sample of the active pane that the path inspector shows first
    bool uses_stored_pane_count = false; ///< whether the last run's number of panes is used, if it is known
    std::function<void(const std::string&)> log; ///< receives a line for each change of state; may be empty
    bool log_controls = false;                   ///< whether the log contains the rectangles of controls
    std::filesystem::path reference;             ///< EXR file to measure errors against; empty: none
    SceneOpener open;                            ///< for files dropped on the window; may be empty
    PictureWriter write_exr;                     ///< empty: no EXR file can be saved
    FolderOpener read_jobs;                      ///< empty: no folder of jobs can be followed
    std::filesystem::path jobs;                  ///< folder to follow; empty: none
    GalleryMaker gallery;                        ///< empty: the gallery has recent scenes only
    bool begins_with_gallery = false;
    std::filesystem::path preferences; ///< file that stores the layout; empty: none
    std::function<void()> wake;        ///< called from other threads when a new frame is due
};

} // namespace tessera
