#pragma once

#include "ui/gl/controls.h"
#include "ui/jobs/followed_folder.h"
#include "ui/jobs/scene_load.h"
#include "ui/panels/panels.h"
#include "ui/viewer/viewer_options.h"

namespace tessera {

/// Windows over the pictures: dialogs, gallery, help, command palette, followed folder, loading progress and
/// toasts.
class Overlays {
public:
    /// Fulfils the wish to follow a folder of jobs, if the options have a reader for it.
    void follow_jobs(ViewerState& state, const ViewerOptions& options);

    /// Draws the overlays that the state shows.
    /// @param pictures           area of the panes, screen units
    /// @param load               state of the scene load under way, if there is one
    /// @param thumbnails_stored  number of thumbnails stored so far; the gallery reloads them when it changes
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
