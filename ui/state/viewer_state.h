#pragma once

#include "render/load/mitsuba_xml.h"
#include "render/scene/scene.h"
#include "render/session/session.h"
#include "ui/gl/image_view.h"
#include "ui/gl/theme.h"
#include "ui/gl/tone.h"
#include "ui/state/buffer.h"
#include "ui/state/camera_control.h"
#include "ui/state/companions.h"
#include "ui/state/inspected.h"
#include "ui/state/preferences.h"
#include "ui/state/reference_making.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

inline constexpr int most_render_pixels_an_edge = 8192;

/// How many pixels the panes render.
struct SizeChoice {
    enum class Base { pane, scene, custom };
    Base base = Base::pane; ///< what fits the pane, the film of the scene, or `custom`
    float scale = 1.0f;     ///< of width and height, (0, 2]
    glm::ivec2 custom{640, 360};

    bool operator==(const SizeChoice&) const = default;
};

/// The size to ask for; at least 1x1. For SizeChoice::Base::pane it has the proportions of the film, and a width
/// of small prime factors only, which the Fourier transform of the reconstruction is quick with.
glm::ivec2 render_size(const SizeChoice& choice, glm::ivec2 film_size, glm::ivec2 pane_size);

inline constexpr int most_panes = 4;
/// What a pane is compared with, in place of another's index: the picture that errors are measured against.
inline constexpr int the_reference = most_panes;

/// How a pane shows another pane's picture with its own.
struct Comparison {
    enum class Kind {
        off,
        wipe,       ///< its own to the left of a line, the other's to the right
        difference, ///< its own minus the other's, in +/- colours
    };
    Kind kind = Kind::off;
    int with = -1; ///< the other pane, or the_reference; one that is not there: the next

    bool operator==(const Comparison&) const = default;
};

/// What a user sets for one pane.
struct PaneSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction;
    Buffer buffer = Buffer::reconstruction;
    Comparison comparison;

    bool operator==(const PaneSettings&) const = default;
};

struct PaneState {
    PaneSettings settings;
    std::shared_ptr<const Snapshot> snapshot;               ///< the newest; null before the first
    std::uint64_t generation = 0;                           ///< of the request that is out
    glm::ivec2 canvas_size{0};                              ///< pixels of the place for its picture, as last drawn
    std::optional<ReconstructionUnderWay> reconstructing{}; ///< of its newest picture; empty: none is under way
    bool failed = false; ///< its render went wrong: nothing more will come of the request
    int slot = 0; ///< the session's pane that renders it: no other has it, and it keeps it wherever it is shown
};

/// What charts show of a pane.
struct PaneChart {
    std::uint64_t generation = 0;               ///< of the request whose errors these are, ...
    std::shared_ptr<const Reference> reference; ///< ... against this
    /// In the order of their newest points, those without any left out.
    std::vector<ErrorCurve> curves;
    std::uint64_t shift_generation = 0;         ///< of the request whose shifts these are
    PassHistory<ShiftPoint> shifts;             ///< without points where the method makes none
    std::uint64_t histogram_generation = 0;     ///< of the request whose histogram it is
    std::shared_ptr<const Histogram> histogram; ///< of the newest picture; null: none yet
};

/// What a chart shows of the panes, against time or samples.
enum class ChartKind {
    error,      ///< relMSE to the reference
    efficiency, ///< 1 / (relMSE x seconds)
    shifts,     ///< how many of the shifts ended how
};

/// What a file is chosen for.
enum class FilePurpose { scene, reference, settings };

struct Message {
    enum class Kind { note, error };
    /// What it is about: a scene's messages go when another takes its place, a failed load's at the next load.
    enum class Origin { viewer, scene, failed_load };
    Kind kind;
    std::string text;
    Origin origin = Origin::viewer;
    std::vector<SampleChoice> samples{}; ///< that it is about, which can be inspected
    std::size_t next_sample = 0;         ///< of these: the one that its button opens
};

/// PT, G-PT, PR and G-PR, or fewer of them: what so many panes start with.
std::vector<PaneSettings> default_panes(int count);

/// What the mouse points at.
struct Cursor {
    int pane = 0;
    glm::vec2 place{0}; ///< fractions of the image, from its top left; may lie outside
    float share = 0;    ///< of the pane's width, from the left
};

/// Everything that panels, actions and the mouse may change. They do no more than that: the viewer compares the
/// state with what it last asked of the session, and sends what differs.
struct ViewerState {
    std::shared_ptr<const Scene> scene; ///< null while the first is loading
    std::string scene_name;
    SceneSource scene_source; ///< without a file: it is in none
    int scenes_shown = 0;     ///< so far, reloaded ones counted again
    std::string loading;      ///< what of the next scene is being loaded; empty: none is

    Companions companions;                  ///< what some buffers need
    std::vector<std::string> recent_scenes; ///< files, the newest first
    std::string reference_file;             ///< a wish: to be loaded as the reference
    std::optional<float> reference_read;    ///< the share of it that is read so far, [0, 1]; empty: none is read
    ReferenceMaking reference_making;

    std::vector<PaneState> panes;          ///< 1, 2 or 4 (3 work as well); all of them render
    std::vector<PaneSettings> spare_panes; ///< settings of panes taken away, the last one first
    int active_pane = 0;
    bool alone = false; ///< only the active pane is on show
    bool linked = true; ///< all panes share their settings, but for method and buffer

    CameraControl camera;
    ImageView view;
    SizeChoice size;
    glm::ivec2 latched_size{16, 9}; ///< request_size()
    Tone tone;
    bool mark_negative = false; ///< as NaN and infinity always are
    bool magnifier = false;
    bool show_tiles = false;
    Inspector inspector;
    SampleForm sample_form; ///< its dialog
    SlowMotion slow_motion;
    SpaceView space;      ///< of the inspector, or the slow motion
    float wipe = 0.5f;    ///< where wiped pictures are divided, a share of a pane's width
    bool flicker = false; ///< while a key is held: the active pane shows the one that it is compared with
    std::map<Buffer, ValueRange> ranges; ///< of false colours, where the user has set them
    std::optional<Cursor> cursor;        ///< empty: it is over no picture
    Pace pace;
    bool paused = false;
    double patience = 0.5; ///< seconds for which a reconstruction goes on untold

    Theme theme = Theme::dark;
    glm::ivec2 window_size{0}; ///< as last drawn, screen units
    WindowPlace window_place;  ///< as it is now
    float display_scale = 1;   ///< of text and controls, as the display says
    float text_factor = 1;     ///< against that: another display has text as large as this one
    float panel_width = 20;    ///< of the panels at the side, in heights of a line
    bool show_panel = true;
    bool show_statistics = false;
    bool show_charts = false;
    bool large_charts = false; ///< over the pictures instead of in their panel
    ChartKind chart_kind = ChartKind::error;
    bool charts_by_spp = false;               ///< against samples; otherwise against seconds
    std::array<PaneChart, most_panes> charts; ///< by slot: see chart_of
    bool histograms_due = false;              ///< those of some pictures are still being measured
    bool show_help = false;
    bool show_messages = false;
    std::optional<FilePurpose> choosing; ///< a file, in the dialog for it; empty: it is closed
    std::vector<Message> messages;
    bool scroll_to_newest = false; ///< the list is to show its end
    bool redraw = false;           ///< something has come since this was drawn, and is to be seen

    // Wishes, cleared by who fulfils them.
    bool restart = false;
    int steps = 0; ///< passes to do though paused
    bool reload = false;
    bool cancel_load = false;             ///< the scene that is being loaded is wanted no more
    bool give_up_reconstructions = false; ///< those under way are wanted no more
    bool cancel_reference = false;        ///< the reference that is being read is wanted no more
    bool save_camera = false;
    bool copy_camera = false;
    bool save_picture = false; ///< of the window
    bool save_view = false;    ///< of the active pane's image
    bool save_charts = false;  ///< as CSV, SVG and PNG
    bool save_exr = false;     ///< of the active pane
    bool save_settings = false;
    std::string open_scene;    ///< a file
    std::string settings_file; ///< to be loaded, once no scene is on its way
    bool quit = false;

    PaneState& active() { return panes[static_cast<std::size_t>(active_pane)]; }
    const PaneState& active() const { return panes[static_cast<std::size_t>(active_pane)]; }

    static constexpr float least_ui_scale = 1, most_ui_scale = 3;
    /// Of text and controls.
    float ui_scale() const { return std::clamp(display_scale * text_factor, least_ui_scale, most_ui_scale); }
    /// Sets the factor that leads to it on this display.
    void set_ui_scale(float scale) {
        text_factor = std::clamp(scale, least_ui_scale, most_ui_scale) / display_scale;
    }

    static constexpr float least_panel_width = 14, most_panel_width = 48;

    /// Adds panes, with the settings of those taken away or a method that no pane has yet, or takes the last away;
    /// the active one stays. `count` of 1 to most_panes.
    void set_pane_count(int count);

    /// The pane that the session's slot renders; null: none is.
    const PaneState* pane_in(int slot) const;

    /// What charts show of a pane. It is the slot's that renders it, and so stays when the layout changes.
    PaneChart& chart_of(const PaneState& pane) { return charts[static_cast<std::size_t>(pane.slot)]; }
    const PaneChart& chart_of(const PaneState& pane) const { return charts[static_cast<std::size_t>(pane.slot)]; }

    /// The picture lies so from now on, also after the slow motion, which would put it back.
    void set_view(const ImageView& now) {
        view = now;
        slow_motion.view_before.reset();
    }

    /// The path inspector, and the slow motion, which begins with the tile that SlowMotionJob chooses. Both have
    /// the mouse's left button: the other gives way.
    void set_inspector(bool on);
    void set_slow_motion(bool on);

    /// Opens a sample in the path inspector, ...
    void inspect(const SampleChoice& sample);
    /// ... or one of the active pane, which gets that seed (with the others, where they are linked).
    void inspect(glm::ivec2 pixel, int pass, std::uint64_t seed);

    /// Whether a pane still shows the request of that generation.
    bool shows_request(std::uint64_t generation) const;
    bool is_on_show(int pane) const { return !alone || pane == active_pane; }

    /// What `pane` is compared with: another pane or the_reference; itself if there is neither.
    int compared_with(int pane) const;

    /// Whether the pane's reconstruction is worth telling of: others are over before they are read of.
    bool reconstructs_long(const PaneState& pane) const {
        return pane.reconstructing && pane.reconstructing->seconds > patience;
    }
    /// The size that all panes are to render, pixels: not what fits best at the moment, see SessionLink.
    glm::ivec2 request_size() const { return latched_size; }
    /// The size that the choice and the panes on show now come to, pixels.
    glm::ivec2 fitting_size() const;

    /// Adds a message; an error opens the list at its end.
    void add_message(Message::Kind kind, std::string text, Message::Origin origin = Message::Origin::viewer);

    /// A note of the scene on samples that a render refused, the first few of which can be inspected if the scene
    /// is still on show; none, if there are none. `whose` begins it; `slot` is of the pane that rendered it, or is
    /// to be followed later.
    void add_refused(const std::string& whose, const Counters& counters, int slot, const PassOrigin& origin);

    /// Takes away the messages of that origin. Closes the list if that leaves no error of some.
    void drop_messages(Message::Origin origin);

    /// Gives the active pane's settings to all panes, if they are linked. Each keeps its method and buffer.
    void share_settings();
};

} // namespace tessera
