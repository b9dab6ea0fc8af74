#pragma once

#include "ui/gl/controls.h"
#include "ui/gl/gl.h"
#include "ui/settings/settings_file.h"
#include "ui/state/actions.h"
#include "ui/state/viewer_state.h"
#include "ui/viewer/background_work.h"
#include "ui/viewer/overlays.h"
#include "ui/viewer/picture_area.h"
#include "ui/viewer/saver.h"
#include "ui/viewer/scene_switch.h"
#include "ui/viewer/session_link.h"
#include "ui/viewer/viewer_memory.h"
#include "ui/viewer/viewer_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// The viewer without its window. Owns the state, draws frames and fulfils the wishes in the state. The session
/// must have most_panes panes. To be used from one thread, with an OpenGL context and Dear ImGui's context
/// current.
class Viewer {
public:
    Viewer(Session& session, ViewerOptions options);
    ~Viewer(); ///< waits for files that are being saved, and calls remember()

    /// Loads a scene in the background, and cancels the load under way. The scene on show stays until the new one
    /// is complete.
    /// @param source  file of the scene; without a file, the scene is not in a file
    void load(std::string name, SceneLoader loader, SceneSource source = {});

    /// Opens files dropped on the window: the first scene, the first EXR file as the reference, and the first
    /// settings file, which applies once the scene is on show.
    void drop(const std::vector<std::filesystem::path>& files);

    /// Stores the layout and the recent scenes for the next run at once.
    void remember() const { memory_.store(state_); }

    /// Draws one frame, between Gui's begin and end. Takes new results, then sends changes to the session.
    void draw_frame();

    /// Returns the seconds until the next frame is due without any event; 0: at once; infinity: never.
    double next_frame_in() const;

    ViewerState& state() { return state_; }
    const ViewerState& state() const { return state_; }
    Keyboard& keyboard() { return keyboard_; }
    Saver& saver() { return saver_; }
    const Controls& controls() const { return controls_; }
    const PictureArea& pictures() const { return pictures_; }
    bool loading() const { return scenes_.under_way().running(); }
    /// Whether the contents of the path inspector are incomplete.
    bool inspecting() const { return work_.inspecting(); }

    /// Whether every pane shows at least `spp` samples per pixel of its current request, reconstructed.
    bool settled(int spp) const;

    /// Whether the last frame showed all results that had arrived by its end.
    bool all_drawn() const { return !state_.wishes.redraw && frames_due_ == 0; }

private:
    void open(const std::filesystem::path& file);
    void fulfil_wishes();
    void load_settings(const std::filesystem::path& file);
    void read_keyboard();
    void draw_side(const ScreenRect& where);
    /// Heights of the panels below the pictures, screen units; 0: the panel is closed.
    struct BottomHeights {
        float messages = 0, inside = 0;
    };
    BottomHeights bottom_heights(float room) const;
    void draw_bottom(const ScreenRect& where, const BottomHeights& heights);
    void draw_panels();
    void note_history();
    void log_changes();

    ViewerOptions options_;
    ViewerState state_;
    SessionLink link_;
    Keyboard keyboard_;
    Controls controls_;
    PictureArea pictures_;
    Overlays overlays_;
    SceneSwitch scenes_;
    Saver saver_;
    ViewerMemory memory_;
    ChangeLog change_log_;
    bool flying_ = false; // a key moves the camera
    int frames_due_ = 0;  // further frames to draw without any event
    BackgroundWork work_; // last, because its destructor waits for a pass
};

} // namespace tessera
