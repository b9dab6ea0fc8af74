#pragma once

#include "render/session/session.h"
#include "ui/jobs/followed_folder.h"
#include "ui/jobs/jobs.h"
#include "ui/jobs/save_queue.h"
#include "ui/jobs/scene_load.h"
#include "ui/panels/panels.h"
#include "ui/panes/pane_view.h"
#include "ui/settings/preferences.h"
#include "ui/settings/settings_file.h"
#include "ui/state/actions.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// The viewer's dealings with the session: compares the state with what was last asked, sends what differs, and
/// takes in what has come.
class SessionLink {
public:
    /// `session` of most_panes panes.
    explicit SessionLink(Session& session) : session_(session) {}

    /// Takes in snapshots and messages.
    void take(ViewerState& state);
    /// Sends requests in the frame in which the state changed. Fulfils the wishes to restart and to step.
    void send(ViewerState& state);

private:
    /// What a slot was last asked for.
    struct Sent {
        std::shared_ptr<const Scene> scene; // null: nothing
        Camera camera;
        glm::ivec2 size{0};
        RenderSettings render;
        ReconstructionSettings reconstruction;
        std::uint64_t generation = 0;
        int followed = -1; // the slot whose passes it shows; -1: it renders them
    };
    /// What the user has given the pictures' size by, but for panels.
    struct Arrangement {
        glm::ivec2 window{0};
        std::size_t panes = 0;
        bool operator==(const Arrangement&) const = default;
    };
    Sent& sent_of(const PaneState& pane) { return sent_[static_cast<std::size_t>(pane.slot)]; }
    const Sent& sent_of(const PaneState& pane) const { return sent_[static_cast<std::size_t>(pane.slot)]; }
    bool starts_anew(const ViewerState& state, const PaneState& pane) const;
    void latch_size(ViewerState& state);
    std::size_t renders_for(const ViewerState& state, std::size_t pane) const;
    static void give_slot(ViewerState& state, PaneState& pane, int slot);
    void send_panes(ViewerState& state);
    void send_pane(ViewerState& state, PaneState& pane);
    void let_follow(PaneState& pane, const PaneState& other);
    void send_running(const ViewerState& state);
    void give_up_reconstructions(ViewerState& state);
    void report_refused(ViewerState& state, std::size_t pane);

    Session& session_;
    std::array<Sent, most_panes> sent_;                    // by slot, as the next
    std::array<std::uint64_t, most_panes> refused_told_{}; // the generation whose refused samples have a message
    SizeChoice latched_choice_; // what the size that is rendered was found by, as the next
    Arrangement latched_arrangement_;
    bool sent_paused_ = false;
    Pace sent_pace_;
};

/// What is saved of a pane.
struct SavedPicture {
    std::shared_ptr<const Snapshot> snapshot;
    ReconstructionSettings reconstruction;
    SceneSource source;                         ///< without a file: it is in none
    std::shared_ptr<const Scene> scene;         ///< for first hits; null: it is no more
    std::shared_ptr<const Reference> reference; ///< for errors; null: there is none
};

/// Writes a picture with its layers, camera and settings to an EXR file; called from a thread other than the UI's.
/// Throws std::exception, whose what() is shown.
using PictureWriter = std::function<void(const std::filesystem::path& file, const SavedPicture& picture)>;

struct ViewerOptions {
    std::vector<PaneSettings> panes; ///< what each pane starts with; 1 to most_panes
    std::optional<int> max_depth;    ///< otherwise the scene decides
    SizeChoice size;
    int spp_limit = 0;
    int threads = 0;                             ///< of references that are made; as in ThreadPool
    std::optional<SampleChoice> sample;          ///< to begin with in the path inspector, of the active pane
    bool panes_as_remembered = false;            ///< as many as the last time, if that is known
    std::function<void(const std::string&)> log; ///< gets a line for every change of state; may be empty
    bool log_controls = false;                   ///< also where each control lies
    std::filesystem::path reference;             ///< EXR file to measure errors against; empty: none
    SceneOpener open;                            ///< for files dropped on the window; may be empty
    PictureWriter write_exr;                     ///< may be empty
    FolderOpener read_jobs;                      ///< may be empty: no folder of jobs can be followed
    std::filesystem::path jobs;                  ///< folder to follow; empty: none
    GalleryMaker gallery;                        ///< may be empty: there is none
    bool begins_with_gallery = false;
    std::filesystem::path preferences; ///< file that remembers the layout; empty: none does
    std::function<void()> wake;        ///< called from other threads when there is something new to draw
};

/// The viewer without its window, on a session of most_panes panes: the state, what is drawn of it, and its
/// dealings with the session. To be used from one thread, with an OpenGL context and Dear ImGui's context current.
class Viewer {
public:
    Viewer(Session& session, ViewerOptions options);
    ~Viewer(); ///< waits for what is being saved, and remember()s

    /// Loads a scene in the background; the old one stays until it is there. One that is still being loaded is
    /// given up. `source` is where it comes from, without a file: from none.
    void load(std::string name, SceneLoader loader, SceneSource source = {});

    /// Loads the scene on show again: the camera stays unless the file's has changed, and so do all settings.
    /// Where there is none yet, the one that was to be loaded last.
    void reload();

    /// Takes the first scene file among those dropped on the window, the first EXR file as the reference, and the
    /// first settings, which count once the scene is there.
    void drop(const std::vector<std::filesystem::path>& files);

    /// Writes in the background, after what is being written already: a message then says "Saved " and what that
    /// was, or what was thrown.
    void save(SaveQueue::Work write) { save_queue_.add(std::move(write), options_.wake); }
    /// The file that was chosen, or where it is empty one that is named by the date and this ending, where was
    /// saved last.
    std::filesystem::path file_to_save(const std::string& chosen, const std::string& ending) const;
    bool saving() const { return save_queue_.running(); }

    /// Stores what the next viewer begins with: the layout, the recent scenes. At once.
    void remember();

    /// Draws one frame, between Gui's begin and end. Takes in what is new, then sends what changed to the session.
    void draw_frame();

    /// Seconds until the next frame is due although nothing happens; 0: at once; large: none.
    double next_frame_in() const;

    ViewerState& state() { return state_; }
    const ViewerState& state() const { return state_; }
    Keyboard& keyboard() { return keyboard_; }
    const Controls& controls() const { return controls_; }
    const PaneView& pane_view(int pane) const { return pane_views_[static_cast<std::size_t>(pane)]; }
    const PaneImage& pane_image(int pane) const { return images_[static_cast<std::size_t>(pane)]; }
    const PaneImages& pane_images() const { return images_; }
    bool loading() const { return load_.running(); }
    /// Whether what the path inspector is to show is still being found out.
    bool inspecting() const { return inspection_job_.running() || surroundings_job_.running(); }

    /// Whether every pane shows `spp` samples a pixel of what is now asked for, and their reconstruction.
    bool settled(int spp) const;

    /// Whether the last frame showed all that had come by its end.
    bool all_drawn() const { return !state_.wishes.redraw && frames_due_ == 0; }

private:
    void take_scene();
    void show_scene(std::shared_ptr<const Scene> scene, const SceneOrigin& origin);
    void open(const std::filesystem::path& file);
    void fulfil_wishes();
    void load_settings(const std::filesystem::path& file);
    /// Those that were to follow a scene which does not come; not those for the one that is shown.
    void drop_settings_of(const SceneOrigin& origin);
    void follow_jobs();
    void fulfil_saves();
    void take(const SaveQueue::Outcome& outcome);
    // Each saves to the file, or to one that is named by the date.
    void save_camera(const std::string& file);
    void save_settings(const std::string& file);
    void save_exr(const std::string& file);
    void save_picture(const std::string& file);
    void save_charts(const std::string& file);
    void take_preferences();
    Preferences current_preferences() const;
    void take(const KeptPreferences& kept);
    void remember_later();
    void keep_thumbnail();
    void read_keyboard();
    void draw_side(const ScreenRect& where);
    void draw_panes(const ScreenRect& where);
    struct BottomHeights {
        float messages = 0, inside = 0;
    };
    BottomHeights bottom_heights(float room) const;
    void draw_bottom(const ScreenRect& where, const BottomHeights& heights);
    void draw_overlays(const ScreenRect& pictures);
    void expose();
    void note_history();
    void log_changes();

    SessionLink link_;
    ViewerOptions options_;
    ViewerState state_;
    Keyboard keyboard_;
    Controls controls_;
    CanvasShader shader_;
    PaneImages images_;
    std::array<PaneView, most_panes> pane_views_;
    CompanionJobs companion_jobs_;
    InspectionJob inspection_job_;
    SlowMotionJob slow_motion_job_;
    SurroundingsJob surroundings_job_;
    ChartJob chart_job_;
    FileDialog file_dialog_;
    CommandPalette palette_;
    FolderFollower follower_;
    JobsPanel jobs_panel_;
    Gallery gallery_;
    HelpPage help_;
    SaveQueue save_queue_;
    Preferences preferences_;                // as the file last had them
    std::string told_of_preferences_;        // the last note
    int asked_panes_ = 0;                    // so many were asked for this once; 0: as remembered
    std::vector<std::string> opened_scenes_; // by this viewer, the last one last
    int pictured_ = 0;                       // state_.scenes_shown of the scene whose thumbnail was kept
    int thumbnails_stored_ = 0;
    SceneLoad load_;
    SceneOrigin shown_; // where the scene on show is from
    SceneOrigin asked_; // the last that was to be loaded
    bool flying_ = false;
    int frames_due_ = 0; // after this one, although nothing happens
    ChangeLog change_log_;
    ReferenceJob reference_job_; // last: its end waits for a pass
};

/// Saves what can be seen: fulfils the wish to save the window's picture, some frames after it came up, when the
/// menu that it came from is closed.
class PictureSaver {
public:
    /// To be called after each frame, while it is bound for reading. `pixels`: of its framebuffer. True: another
    /// frame is due.
    bool after_frame(Viewer& viewer, glm::ivec2 pixels);

private:
    int age_ = 0; // frames since the wish
};

} // namespace tessera
