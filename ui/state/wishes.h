#pragma once

#include <string>

namespace tessera {

/// What panels, actions and the mouse ask for. Who fulfils a wish clears it.
struct Wishes {
    bool redraw = false;           ///< something has come since the last frame was drawn, and is to be seen
    bool scroll_to_newest = false; ///< of the list of messages
    bool quit = false;

    // These are for the session.
    bool restart = false;
    int steps = 0;                        ///< passes to do though paused
    bool give_up_reconstructions = false; ///< those under way for long

    // These are for what is read. An empty name is no file. Settings wait until no scene is on its way.
    bool reload = false; ///< the scene on show
    std::string open_scene;
    std::string open_reference;
    std::string open_settings;
    bool cancel_scene = false;     ///< the one that is being loaded
    bool cancel_reference = false; ///< the one that is being read

    // These are for what is saved or made.
    bool save_camera = false;
    bool copy_camera = false;  ///< to the clipboard
    bool save_picture = false; ///< of the window
    bool save_view = false;    ///< of the active pane's image
    bool save_charts = false;  ///< as CSV, SVG and PNG
    bool save_exr = false;     ///< of the active pane
    bool save_settings = false;
    bool make_reference = false; ///< as ViewerState::reference_making says
    bool stop_making = false;    ///< that reference
};

} // namespace tessera
