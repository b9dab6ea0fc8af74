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

/// Keeps what the viewer remembers from one run to the next, in a file that other viewers write as well: the
/// layout, the number of panes, the recent scenes and their thumbnails. Without a file it does nothing.
class ViewerMemory {
public:
    explicit ViewerMemory(std::filesystem::path file) : file_(std::move(file)) {}

    /// Puts what the last run has stored into the state.
    /// @param asked_panes  number of panes of the command line, which is for this run only; 0: the stored one
    void restore(ViewerState& state, int asked_panes);

    /// Puts a scene before the recent ones, and stores in the background: the disk can be slow.
    void add_scene(const std::filesystem::path& scene, ViewerState& state, Saver& saver);
    /// Stores at once.
    void store(const ViewerState& state) const;

    /// Stores a picture of the scene on show for the gallery, once, in the background, when it has enough samples.
    void keep_thumbnail(const ViewerState& state, const SceneSource& shown, Saver& saver);
    int thumbnails_stored() const { return thumbnails_stored_; } ///< in this run

private:
    Preferences current(const ViewerState& state) const;
    void take(const KeptPreferences& kept, ViewerState& state);

    std::filesystem::path file_;
    Preferences stored_;              // as last read from the file
    std::string told_;                // last note on the file
    int asked_panes_ = 0;             // see restore()
    std::vector<std::string> opened_; // scenes of this run, the last one last
    int pictured_ = 0;                // ViewerState::scenes_shown of the newest thumbnail
    int thumbnails_stored_ = 0;
};

} // namespace tessera
