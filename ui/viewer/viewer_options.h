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

/// The picture of a pane with everything that its EXR file describes.
struct SavedPicture {
    std::shared_ptr<const Snapshot> snapshot;
    ReconstructionSettings reconstruction;
    SceneSource source;                         ///< without a file: the scene is in none
    std::shared_ptr<const Scene> scene;         ///< for first hits; null: the scene is gone
    std::shared_ptr<const Reference> reference; ///< for errors; null: none is loaded
};

/// Writes a picture with its layers, camera and settings to an EXR file; called from a thread other than the UI's.
/// Throws std::exception, whose what() becomes a message.
using PictureWriter = std::function<void(const std::filesystem::path& file, const SavedPicture& picture)>;

/// The command line's choices, and the program's functions that the viewer calls.
struct ViewerOptions {
    std::vector<PaneSettings> panes; ///< initial settings of each pane; 1 to most_panes
    std::optional<int> max_depth;    ///< of all scenes; empty: each scene's own
    SizeChoice size;
    int spp_limit = 0;                           ///< samples per pixel at which panes rest; 0: no limit
    int threads = 0;                             ///< of the renders that make references; as in ThreadPool
    std::optional<SampleChoice> sample;          ///< of the active pane, which the path inspector shows first
    bool panes_as_remembered = false;            ///< the number of panes of the last run, if known
    std::function<void(const std::string&)> log; ///< receives a line for every change of state; may be empty
    bool log_controls = false;                   ///< whether the log has the place of each control as well
    std::filesystem::path reference;             ///< EXR file to measure errors against; empty: none
    SceneOpener open;                            ///< for files dropped on the window; may be empty
    PictureWriter write_exr;                     ///< may be empty: no EXR file can be saved
    FolderOpener read_jobs;                      ///< may be empty: no folder of jobs can be followed
    std::filesystem::path jobs;                  ///< folder to follow; empty: none
    GalleryMaker gallery;                        ///< may be empty: the gallery has recent scenes only
    bool begins_with_gallery = false;
    std::filesystem::path preferences; ///< file that remembers the layout; empty: none
    std::function<void()> wake;        ///< called from other threads when there is something new to draw
};

} // namespace tessera
