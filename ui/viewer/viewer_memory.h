#pragma once

#include "render/load/scene_source.h"
#include "ui/settings/preferences.h"
#include "ui/state/viewer_state.h"
#include "ui/viewer/saver.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

/// Stores the layout, the number of panes, the recent scenes and their thumbnails for the next run. Other viewers
/// write the same file. Without a file, nothing is stored.
class ViewerMemory {
public:
    explicit ViewerMemory(std::filesystem::path file) : file_(std::move(file)) {}

    /// Puts the stored preferences into the state.
    /// @param asked_panes  number of panes that the command line sets for this run only; 0: the stored number
    void restore(ViewerState& state, int asked_panes);

    /// Adds a scene to the recent ones, and stores the preferences in the background, because the disk can be
    /// slow.
    void add_scene(const std::filesystem::path& scene, ViewerState& state, Saver& saver);
    /// Stores the preferences at once.
    void store(const ViewerState& state) const;

    /// Stores a thumbnail of the scene on show for the gallery, in the background, once per scene and when a pane
    /// has enough samples.
    void keep_thumbnail(const ViewerState& state, const SceneSource& shown, Saver& saver);
    int thumbnails_stored() const { return thumbnails_stored_; } ///< in this run

private:
    Preferences current(const ViewerState& state) const;
    void take(const LoadedPreferences& kept, ViewerState& state);

    std::filesystem::path file_;
    Preferences stored_;              // last read from the file
    std::string reported_note_;       // last reported note on the file
    int asked_panes_ = 0;             // see restore()
    std::vector<std::string> opened_; // scenes of this run, the newest last
    int thumbnail_scene_ = 0;         // SceneInfo::shown of the newest thumbnail
    int thumbnails_stored_ = 0;
};

} // namespace tessera
