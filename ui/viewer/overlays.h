#pragma once

#include "ui/gl/controls.h"
#include "ui/jobs/followed_folder.h"
#include "ui/jobs/scene_load.h"
#include "ui/panels/panels.h"
#include "ui/viewer/viewer_options.h"

namespace tessera {

/// The windows over the pictures: dialogs, gallery, help, list of commands, followed folder, progress and toasts.
class Overlays {
public:
    /// Starts to follow the folder that the state wishes for, if the options can read one.
    void follow_jobs(ViewerState& state, const ViewerOptions& options);

    /// Draws those that the state shows.
    /// @param pictures           the part of the window that has the panes
    /// @param load               the scene that is being loaded, if one is
    /// @param thumbnails_stored  so far; the gallery reads its pictures again when the number changes
    void draw(const ScreenRect& pictures, Controls& controls, ViewerState& state, const ViewerOptions& options,
              const SceneLoad& load, int thumbnails_stored);

private:
    FileDialog file_dialog_;
    CommandPalette palette_;
    FolderFollower follower_;
    JobsPanel jobs_panel_;
    Gallery gallery_;
    HelpPage help_;
};

} // namespace tessera
