#pragma once

#include "render/load/scene_source.h"
#include "render/session/session.h"
#include "ui/gl/image_view.h"
#include "ui/gl/tone.h"
#include "ui/state/buffer.h"
#include "ui/state/camera_control.h"
#include "ui/state/companions.h"
#include "ui/state/inspected.h"
#include "ui/state/pane_set.h"
#include "ui/state/reference_making.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

class Scene;

/// Data of a pane's charts.
struct PaneChart {
    std::vector<ErrorCurve> curves; ///< with at least one point, in the order of their newest points
    std::uint64_t generation = 0;   ///< request of the curves
    /// The reference of these errors; null: they are estimates from the samples (recon/metrics/sample_error.h).
    std::shared_ptr<const Reference> reference;
    std::uint64_t shift_generation = 0;         ///< request of `shifts`
    PassHistory<ShiftPoint> shifts;             ///< without points if the method has no shifts
    std::uint64_t histogram_generation = 0;     ///< request of the histogram
    std::shared_ptr<const Histogram> histogram; ///< of the newest picture; null: none is measured
};

/// The charts' data by slot, so that a pane keeps its own when the layout changes.
struct PaneCharts {
    std::array<PaneChart, most_panes> by_slot;
    bool histograms_due = false; ///< the measurement of some histograms is incomplete

    PaneChart& operator[](std::size_t slot) { return by_slot[slot]; }
    const PaneChart& operator[](std::size_t slot) const { return by_slot[slot]; }
    PaneChart& of(const PaneState& pane) { return by_slot[pane.slot]; }
    const PaneChart& of(const PaneState& pane) const { return by_slot[pane.slot]; }
};

inline constexpr int most_render_pixels_an_edge = 8192;

/// Choice of the rendered size.
struct SizeChoice {
    enum class Base { pane, scene, custom };
    Base base = Base::pane; ///< size of the pane, of the scene's film, or `custom`
    float scale = 1.0f;     ///< of width and height, (0, 2]
    glm::ivec2 custom{640, 360};

    bool operator==(const SizeChoice&) const = default;
};

/// Returns the size to render; at least 1x1. For SizeChoice::Base::pane it has the proportions of the film, and a
/// width with small prime factors only, which makes the Fourier transform of the reconstruction fast.
glm::ivec2 render_size(const SizeChoice& choice, glm::ivec2 film_size, glm::ivec2 pane_size);

struct Message {
    enum class Kind { note, error };
    /// Subject. Messages about a scene disappear with the scene, those about a failed load at the next load.
    enum class Origin { viewer, scene, failed_load };
    Kind kind;
    std::string text;
    Origin origin = Origin::viewer;
    std::vector<SampleChoice> samples{}; ///< samples that the message's button opens in the path inspector
    std::size_t next_sample = 0;         ///< index of the one that the button opens next
};

/// The reason why there is no scene although one was asked for.
struct SceneProblem {
    std::string text;     ///< empty: there is a scene, or one is loading
    bool is_error = true; ///< false: the load was cancelled
};

/// Source of the scene, and progress of the next load.
struct SceneInfo {
    std::string name;
    SceneSource source; ///< without a file for a built-in scene
    /// Index of the sensor that the user chose; empty: the one with which the scene was opened.
    std::optional<std::size_t> sensor;
    int shown = 0;                   ///< number of scenes so far, reloads included
    std::string loading;             ///< step of the next scene's load; empty: none is loading
    SceneProblem problem;            ///< of the last load, while there is no scene
    std::vector<std::string> recent; ///< files, the newest first
};

/// Stored views of this scene, in the order in which they were added.
struct Bookmarks {
    std::vector<Bookmark> views;
    int current = -1; ///< index of the last one visited or added; -1: none
};

/// State of rendering, for all panes.
struct Rendering {
    SizeChoice size;
    glm::ivec2 latched_size{16, 9}; ///< Document::request_size()
    Pace pace;
    bool paused = false;
    double patience = 0.5; ///< seconds after which the progress of a reconstruction is shown
};

/// Display settings of all panes.
struct Display {
    ImageView view;
    Tone tone;
    std::map<Buffer, ValueRange> ranges; ///< of false colours, where the user has set them
    bool mark_negative = false;          ///< NaN and infinity are always marked
    bool magnifier = false;
    bool show_tiles = false;
};

/// The user's work: a scene, the panes that render it, their display, and the results. The panes are a base, so
/// that state.panes and state.active() need no further name.
struct Document : PaneSet {
    std::shared_ptr<const Scene> scene; ///< null while the first is loading
    SceneInfo scene_info;
    Companions companions;
    std::optional<float> reference_read; ///< progress of reading a reference, [0, 1]; empty: none is being read
    ReferenceMaking reference_making;
    PaneCharts charts;
    CameraControl camera;
    Bookmarks bookmarks;
    Rendering rendering;
    Display display;
    Inspector inspector;
    SlowMotion slow_motion;
    SpaceView space; ///< of the inspector or the slow motion
    std::vector<Message> messages;

    /// Returns the pane or the_reference with which `pane` is compared; `pane` itself if there is neither.
    int compared_with(int pane) const;

    /// Whether the pane's reconstruction has taken long enough to be shown.
    bool reconstructs_long(const PaneState& pane) const {
        return pane.reconstructing && pane.reconstructing->seconds > rendering.patience;
    }

    /// Returns the size of the sensor's picture, pixels; (16, 9) without a scene.
    glm::ivec2 sensor_size() const;
    /// Moves the camera to a sensor of the scene, which becomes the home view.
    void show_sensor(std::size_t index);

    /// Returns the size that all panes render, pixels. It can differ from the size that fits best, see
    /// SessionLink.
    glm::ivec2 request_size() const { return rendering.latched_size; }

    /// Sets the view of the pictures for good: the end of the slow motion does not restore an earlier one.
    void set_view(const ImageView& now) {
        display.view = now;
        slow_motion.view_before.reset();
    }

    /// Opens or closes the path inspector, or the slow motion, which begins with the tile that SlowMotionJob
    /// chooses. Both use the left mouse button, so that one closes the other.
    void set_inspector(bool on);
    void set_slow_motion(bool on);
};

} // namespace tessera
