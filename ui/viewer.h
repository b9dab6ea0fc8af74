#pragma once

#include "render/session/session.h"
#include "ui/change_log.h"
#include "ui/keyboard.h"
#include "ui/pane_view.h"
#include "ui/scene_load.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

struct ViewerOptions {
    std::vector<PaneSettings> panes; ///< what each pane starts with; as many as the session has
    std::optional<int> max_depth;    ///< otherwise the scene decides
    SizeChoice size;
    int spp_limit = 0;
    bool show_panel = true;
    std::function<void(const std::string&)> log; ///< gets a line for every change of state; may be empty
    bool log_controls = false;                   ///< also where each control lies
    SceneOpener open;                            ///< for files dropped on the window; may be empty
    std::function<void()> wake;                  ///< called from other threads when there is something new to draw
};

/// The viewer without its window: the state, what is drawn of it, and its dealings with the session. To be used
/// from one thread, with an OpenGL context and Dear ImGui's context current.
class Viewer {
public:
    Viewer(Session& session, ViewerOptions options);

    /// Loads a scene in the background; the old one stays until it is there. One that is still being loaded is
    /// given up. `file` is where it comes from, empty: from no file.
    void load(std::string name, SceneLoader loader, std::filesystem::path file = {});

    /// Loads the scene on show again: the camera stays unless the file's has changed, and so do all settings.
    /// Where there is none yet, the one that was to be loaded last.
    void reload();

    /// Loads the first scene file among those dropped on the window.
    void drop(const std::vector<std::filesystem::path>& files);

    /// Draws one frame, between Gui's begin and end. Takes in what is new, then sends what changed to the session.
    void draw_frame();

    /// Seconds until the next frame is due although nothing happens; 0: at once; large: none.
    double next_frame_in() const;

    ViewerState& state() { return state_; }
    Keyboard& keyboard() { return keyboard_; }
    const Controls& controls() const { return controls_; }
    const PaneView& pane_view(int pane) const { return pane_views_[static_cast<std::size_t>(pane)]; }
    bool loading() const { return load_.running(); }

    /// Whether every pane shows `spp` samples a pixel of what is now asked for, and their reconstruction.
    bool settled(int spp) const;

private:
    struct Sent; // what the session was last asked for

    void take_scene();
    void show_scene(std::shared_ptr<const Scene> scene, const SceneOrigin& origin);
    void fulfil_wishes();
    void save_camera();
    void take_snapshots();
    void report_refused(std::size_t pane);
    void read_keyboard();
    void draw_side(const ScreenRect& where);
    void draw_panes(const ScreenRect& where);
    void draw_overlays(const ScreenRect& pictures);
    void send_changes();
    bool differs(const PaneState& pane, const Sent& sent) const;
    void log_changes();

    Session& session_;
    ViewerOptions options_;
    ViewerState state_;
    Keyboard keyboard_;
    Controls controls_;
    CanvasShader shader_;
    std::vector<PaneView> pane_views_;
    SceneLoad load_;
    SceneOrigin shown_; // where the scene on show is from
    SceneOrigin asked_; // the last that was to be loaded
    bool flying_ = false;
    ChangeLog change_log_;

    struct Sent {
        std::shared_ptr<const Scene> scene;
        Camera camera;
        glm::ivec2 size{0};
        RenderSettings render;
        ReconstructionSettings reconstruction;
        int spp_limit = 0;
    };
    std::vector<Sent> sent_;
    std::vector<std::uint64_t> refused_told_; // a pane: the generation whose refused samples have a message
    bool sent_paused_ = false;
};

} // namespace tessera
