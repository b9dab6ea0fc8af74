#pragma once

#include "recon/image.h"
#include "render/film/film.h"
#include "render/scene/camera.h"
#include "render/settings/settings.h"
#include "ui/gl/image_view.h"
#include "ui/state/camera_control.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

class LearnedReuse;
class Scene;
struct InspectedSet;
struct Inspection;
struct TileInspection;

/// Inputs of a render, from which its samples can be traced again.
struct PassOrigin {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    glm::ivec2 size{0};
    RenderSettings settings;
    std::shared_ptr<const LearnedReuse> learned{}; ///< of the pass; null: must be learned again
    std::uint64_t generation = 0;                  ///< of the request; 0: not of a pane
};

/// A sample of a pixel, chosen for inspection.
struct SampleChoice {
    int slot = 0; ///< of its pane (PaneState::slot)
    glm::ivec2 pixel{0};
    std::optional<int> pass;                    ///< from 0; empty: the newest
    std::shared_ptr<const PassOrigin> origin{}; ///< of the pass; null: the pane's present render

    bool operator==(const SampleChoice&) const = default;
};

/// State of the path inspector.
struct Inspector {
    enum class Direction {
        to_pixel,   ///< shifts of other pixels' base paths to the pixel
        from_pixel, ///< shifts of the pixel's base path to other pixels
    };
    bool active = false; ///< the left mouse button chooses a pixel
    std::optional<SampleChoice> sample;
    Direction direction = Direction::to_pixel;
    bool follows = false; ///< shows each new pass; otherwise keeps the one that was the newest when chosen
    int marked = -1;      ///< row of the table under the mouse; -1: none
    int chosen = -1;      ///< row whose vertices are listed; -1: the base path's vertices are listed

    std::shared_ptr<const Inspection> inspection; ///< the newest result; null before the first
    float scene_radius = 0;                       ///< of the inspection's scene
    std::uint64_t generation = 0;                 ///< of the inspection's request
    int slot = 0;                                 ///< of the inspection's pane, while it shows this request

    int shown_row() const { return marked >= 0 ? marked : chosen; }
    void choose(const SampleChoice& choice) {
        if (sample != choice)
            chosen = -1;
        if (sample != choice && choice.pass)
            inspection.reset(); // a given pass can take long to trace
        follows = follows && !choice.pass;
        sample = choice;
    }
    /// Starts or stops following the newest pass of the sample's pane.
    void follow(bool on) {
        follows = on;
        if (on && sample)
            choose({sample->slot, sample->pixel, {}});
    }
};

/// State of the slow motion, which shows the base paths of one tile and pass one by one.
struct SlowMotion {
    static constexpr float least_speed = 0.25f, most_speed = 60; ///< base paths per second

    /// A base path, by the index of its sampling set in the tile and its index in the set.
    struct Place {
        int set = 0, base = 0;
    };

    bool active = false;
    bool held = false;                  ///< paused
    float speed = 3;                    ///< base paths per second
    std::optional<SampleChoice> sample; ///< a pixel of the chosen tile; empty: none is chosen

    std::shared_ptr<const TileInspection> tile; ///< the newest result; null before the first
    int slot = 0;                               ///< of the tile's pane
    std::uint64_t generation = 0;               ///< of the tile's request

    int current = 0;    ///< index of the base path over all sets of the tile; base_count(): all are shown
    float arrived = 0;  ///< progress of its animation, [0, 1]
    float rested = 0;   ///< seconds since the last base path was shown
    bool frames = true; ///< the next frame zooms the picture to the tile
    std::optional<ImageView> view_before; ///< view to restore at the end

    void start(const SampleChoice& choice);
    void rewind();
    /// Sets a traced tile, and rewinds.
    void take(std::shared_ptr<const TileInspection> found, int of_slot, std::uint64_t of_generation);
    /// Advances the animation. Returns whether the tile has ended and the next one is due.
    bool advance(float seconds);
    /// Pauses, and moves by `by` base paths. A step forward first completes the current one.
    void step(int by);
    bool shows_choice() const; ///< whether `tile` contains the chosen sample
    bool is_playing() const { return active && shows_choice() && !held; }

    /// Returns the place of the current base path, or of the last one at the end.
    Place place() const;
    const InspectedSet& set() const; ///< the set of place()
    /// Returns a pixel of the next tile: to the right, else the first in the row below, else the first of all.
    glm::ivec2 next_pixel(glm::ivec2 size) const;
};

/// Background of the 3D view of paths: points that a camera sees first, and points on emitters.
struct Surroundings {
    Camera camera;
    glm::ivec2 size{1}; ///< of the camera's picture, pixels
    std::vector<glm::vec3> points;
    std::vector<Rgb> albedo; ///< one per point
    std::vector<glm::vec3> lamps;
};

/// State of the 3D view of paths.
struct SpaceView {
    CameraControl camera;
    bool fits = true;                                 ///< the next frame moves the camera to see the whole path
    bool has_direction = false;                       ///< the camera's direction is set
    std::shared_ptr<const Surroundings> surroundings; ///< null before they are traced

    /// Takes the direction of another camera, and fits the path.
    void look_as(const Camera& other) {
        camera.put(other, 1);
        fits = has_direction = true;
    }
};

/// Returns the display colour of a shift outcome.
ImU32 outcome_colour(ShiftOutcome outcome);
/// Returns a sentence that explains the outcome.
const char* outcome_help(ShiftOutcome outcome);

/// Returns display colours: the mean of the outcomes' colours of each pixel's shifts, black without shifts.
RgbImage outcome_colours(const ReuseMaps& maps);

/// Returns the outcomes of the shifts to a pixel, the most frequent first: "ok 71 %, occluded 29 %".
std::string outcome_shares(const ReuseCounts& counts);

} // namespace tessera
