#pragma once

#include "render/load/scene_source.h"
#include "render/session/session.h"
#include "ui/gl/image_view.h"
#include "ui/gl/tone.h"
#include "ui/state/buffer.h"
#include "ui/state/camera_control.h"
#include "ui/state/companions.h"
#include "ui/state/inspected.h"
#include "ui/state/reference_making.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

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

/// What so many panes start with: PT, PR, G-PT and G-PR, or the last alone, with PT before it, and with G-PT.
std::vector<PaneSettings> default_panes(int count);

struct PaneState {
    PaneSettings settings;
    std::shared_ptr<const Snapshot> snapshot;               ///< the newest; null before the first
    std::uint64_t generation = 0;                           ///< of the request that is out
    glm::ivec2 canvas_size{0};                              ///< pixels of the place for its picture, as last drawn
    std::optional<ReconstructionUnderWay> reconstructing{}; ///< of its newest picture; empty: none is under way
    bool failed = false;   ///< its render went wrong: nothing more will come of the request
    std::string failure{}; ///< of a failed one: why
    float pass_share = 0;  ///< of the pass under way that is done, [0, 1]
    int slot = 0; ///< the session's pane that renders it: no other has it, and it keeps it wherever it is shown
};

/// Whether the pane's first pass is so long that its progress is worth telling.
bool is_in_long_first_pass(const PaneState& pane);

/// What charts show of a pane.
struct PaneChart {
    /// Those that have points, in the order of their newest ones.
    std::vector<ErrorCurve> curves;
    std::uint64_t generation = 0; ///< of the request whose errors the curves are
    /// That these errors are measured against; null: they are estimates of the samples'
    /// (recon/metrics/sample_error.h).
    std::shared_ptr<const Reference> reference;
    std::uint64_t shift_generation = 0;         ///< of the request whose shifts these are
    PassHistory<ShiftPoint> shifts;             ///< without points where the method makes none
    std::uint64_t histogram_generation = 0;     ///< of the request whose histogram it is
    std::shared_ptr<const Histogram> histogram; ///< of the newest picture; null: none yet
};

class Scene;

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

/// Why there is no scene although one was asked for.
struct SceneProblem {
    std::string text;     ///< empty: there is one, or it is on its way
    bool is_error = true; ///< or it was given up
};

/// What is worked on: a scene, the panes that render it, how their pictures are seen, and what is known of them.
struct Document {
    std::shared_ptr<const Scene> scene; ///< null while the first is loading
    std::string scene_name;
    SceneSource scene_source;               ///< without a file: it is in none
    int scenes_shown = 0;                   ///< so far, reloaded ones counted again
    std::string loading;                    ///< what of the next scene is being loaded; empty: none is
    SceneProblem scene_problem;             ///< the last one's, while there is no scene
    std::vector<std::string> recent_scenes; ///< files, the newest first

    Companions companions;               ///< what some buffers need
    std::optional<float> reference_read; ///< the share of the next one that is read so far, [0, 1]; empty: none is
    ReferenceMaking reference_making;

    std::vector<PaneState> panes;          ///< 1, 2 or 4 (3 work as well); all of them render
    std::vector<PaneSettings> spare_panes; ///< settings of panes taken away, the last one first
    int active_pane = 0;
    int preset = 0;                           ///< of presets(): what settings are held against
    bool linked = true;                       ///< all panes share their settings, but for method and buffer
    std::array<PaneChart, most_panes> charts; ///< by slot: see chart_of
    bool histograms_due = false;              ///< those of some pictures are still being measured

    CameraControl camera;
    std::vector<Bookmark> bookmarks; ///< of this scene's views, in their order
    int bookmark = -1;               ///< the last one that was gone to or made; -1: none
    SizeChoice size;
    glm::ivec2 latched_size{16, 9}; ///< request_size()
    Pace pace;
    bool paused = false;
    double patience = 0.5; ///< seconds for which a reconstruction goes on untold

    ImageView view;
    Tone tone;
    std::map<Buffer, ValueRange> ranges; ///< of false colours, where the user has set them
    bool mark_negative = false;          ///< as NaN and infinity always are
    bool magnifier = false;
    bool show_tiles = false;

    Inspector inspector;
    SlowMotion slow_motion;
    SpaceView space; ///< of the inspector, or the slow motion
    std::vector<Message> messages;

    PaneState& active() { return panes[static_cast<std::size_t>(active_pane)]; }
    const PaneState& active() const { return panes[static_cast<std::size_t>(active_pane)]; }

    /// Adds panes, with the settings of those taken away or a method that no pane has yet, or takes the last away;
    /// the active one stays. `count` of 1 to most_panes. Four methods lie as a table: PT and PR above G-PT and
    /// G-PR.
    void set_pane_count(int count);

    /// The pane that the session's slot renders; null: none is.
    const PaneState* pane_in(int slot) const;

    /// What charts show of a pane. It is the slot's that renders it, and so stays when the layout changes.
    PaneChart& chart_of(const PaneState& pane) { return charts[static_cast<std::size_t>(pane.slot)]; }
    const PaneChart& chart_of(const PaneState& pane) const { return charts[static_cast<std::size_t>(pane.slot)]; }

    /// Gives the active pane's settings to all panes, if they are linked. Each keeps its method and buffer.
    void share_settings();

    /// Whether a pane still shows the request of that generation.
    bool shows_request(std::uint64_t generation) const;

    /// What `pane` is compared with: another pane or the_reference; itself if there is neither.
    int compared_with(int pane) const;

    /// Whether the pane's reconstruction is worth telling of: others are over before they are read of.
    bool reconstructs_long(const PaneState& pane) const {
        return pane.reconstructing && pane.reconstructing->seconds > patience;
    }

    /// The size that all panes are to render, pixels: not what fits best at the moment, see SessionLink.
    glm::ivec2 request_size() const { return latched_size; }

    /// The picture lies so from now on, also after the slow motion, which would put it back.
    void set_view(const ImageView& now) {
        view = now;
        slow_motion.view_before.reset();
    }

    /// The path inspector, and the slow motion, which begins with the tile that SlowMotionJob chooses. Both have
    /// the mouse's left button: the other gives way.
    void set_inspector(bool on);
    void set_slow_motion(bool on);
};

} // namespace tessera
