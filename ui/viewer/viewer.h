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

/// The viewer without its window, on a session of most_panes panes. Owns the state, draws a frame of it, and lets
/// its parts fulfil the wishes in it. To be used from one thread, with an OpenGL context and Dear ImGui's context
/// current.
class Viewer {
public:
    Viewer(Session& session, ViewerOptions options);
    ~Viewer(); ///< waits for what is being saved, and calls remember()

    /// Loads a scene in the background and cancels the load under way; the scene on show stays until then.
    /// @param source  file of the scene; without a file it is in none
    void load(std::string name, SceneLoader loader, SceneSource source = {});

    /// Takes files dropped on the window: the first scene, the first EXR file as the reference, and the first
    /// settings, which apply once the scene is on show.
    void drop(const std::vector<std::filesystem::path>& files);

    /// Stores at once what the next run begins with: the layout and the recent scenes.
    void remember() const { memory_.store(state_); }

    /// Draws one frame, between Gui's begin and end. Takes in what is new, then sends changes to the session.
    void draw_frame();

    /// Returns the seconds until the next frame is due although nothing happens; 0: at once; infinity: none.
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

    /// Whether every pane shows `spp` samples per pixel of the present request, and their reconstruction.
    bool settled(int spp) const;

    /// Whether the last frame showed everything that had come by its end.
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
    int frames_due_ = 0;  // after this one, although nothing happens
    BackgroundWork work_; // last: its destructor waits for a pass
};

} // namespace tessera
