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

/// What a render is made of: enough to take its samples again, whatever is on show by now.
struct PassOrigin {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    glm::ivec2 size{0};
    RenderSettings settings;
    std::shared_ptr<const LearnedReuse> learned{}; ///< of the pass; null: it is to be learnt again
    std::uint64_t generation = 0;                  ///< of the request; 0: no pane's
};

/// One sample of one pixel that is to be looked at.
struct SampleChoice {
    int slot = 0; ///< of its pane (PaneState::slot), wherever that is shown
    glm::ivec2 pixel{0};
    std::optional<int> pass;                    ///< from 0; empty: the newest
    std::shared_ptr<const PassOrigin> origin{}; ///< of the pass; null: what the pane shows

    bool operator==(const SampleChoice&) const = default;
};

/// The sample that is looked at, and what is shown of it.
struct Inspector {
    enum class Direction {
        to_pixel,   ///< which base paths reach the pixel
        from_pixel, ///< where the pixel's own path is taken
    };
    bool active = false; ///< the mouse chooses a pixel
    std::optional<SampleChoice> sample;
    Direction direction = Direction::to_pixel;
    bool follows = false; ///< from pass to pass, not a given one; otherwise the one that was the newest stays
    int marked = -1;      ///< the row of the table under the mouse; -1: none
    int chosen = -1;      ///< the row whose vertices are listed; -1: those of the base path are

    /// The newest that has been found out; null: nothing yet.
    std::shared_ptr<const Inspection> inspection;
    float scene_radius = 0;       ///< of the scene that it was found out from
    std::uint64_t generation = 0; ///< of the request that it was found out from
    int slot = 0;                 ///< of the pane whose it is, if that still shows this request

    int shown_row() const { return marked >= 0 ? marked : chosen; }
    void choose(const SampleChoice& choice) {
        if (sample != choice)
            chosen = -1;
        if (sample != choice && choice.pass)
            inspection.reset(); // it may take a while
        follows = follows && !choice.pass;
        sample = choice;
    }
    /// Looks at the newest pass from now on, of what the pane of the sample shows; or no longer.
    void follow(bool on) {
        follows = on;
        if (on && sample)
            choose({sample->slot, sample->pixel, {}});
    }
};

/// One tile of a pass, whose base paths arrive one after the other.
struct SlowMotion {
    static constexpr float least_speed = 0.25f, most_speed = 60;

    /// The base path that arrives, in which of the tile's sampling sets.
    struct Place {
        int set = 0, base = 0;
    };

    bool active = false;
    bool held = false;                  ///< waits for steps by hand
    float speed = 3;                    ///< base paths a second
    std::optional<SampleChoice> sample; ///< a pixel of the tile; empty: it is to be found

    /// The newest that has been found out; null: nothing yet.
    std::shared_ptr<const TileInspection> tile;
    int slot = 0;                 ///< of the pane whose it is
    std::uint64_t generation = 0; ///< of the request that it was found out from

    int current = 0;    ///< base path of the tile, over all its sets; base_count(): all have arrived
    float arrived = 0;  ///< how far that has come, [0, 1]
    float rested = 0;   ///< seconds since all have arrived
    bool frames = true; ///< the picture is to be moved and enlarged, so that the tile is seen well
    std::optional<ImageView> view_before; ///< the picture goes back to it

    void start(const SampleChoice& choice);
    void rewind();
    /// A tile that was asked for is there.
    void take(std::shared_ptr<const TileInspection> found, int of_slot, std::uint64_t of_generation);
    /// Lets time go by. True: the tile is over, and the next one is due.
    bool advance(float seconds);
    /// Goes one base path on, or back, and waits there.
    void step(int by);
    bool shows_choice() const;
    bool is_playing() const { return active && shows_choice() && !held; }

    /// The place of the base path that arrives; the last one's once all have.
    Place place() const;
    const InspectedSet& set() const; ///< that of place()
    /// A pixel of the tile to the right of this, or of the first one in the row below; after the last the first.
    glm::ivec2 next_pixel(glm::ivec2 size) const;
};

/// What is hinted at around paths in space: what a camera sees first, and where lamps are.
struct Surroundings {
    Camera camera;
    glm::ivec2 size{1}; ///< of its picture
    std::vector<glm::vec3> points;
    std::vector<Rgb> albedo; ///< one a point
    std::vector<glm::vec3> lamps;
};

/// The small view of paths in space.
struct SpaceView {
    CameraControl camera;
    bool fits = true;                                 ///< is to show the whole path, from where it looks
    bool has_direction = false;                       ///< it has a direction to look in
    std::shared_ptr<const Surroundings> surroundings; ///< null: none yet

    /// Is to look where another camera does, from where it then sees the whole path.
    void look_as(const Camera& other) {
        camera.put(other, 1);
        fits = has_direction = true;
    }
};

/// The colour that stands for how a shift ended, wherever that is shown.
ImU32 outcome_colour(ShiftOutcome outcome);
/// What it means, in a sentence.
const char* outcome_help(ShiftOutcome outcome);

/// Display colours: of each pixel the mean of its shifts' colours. Black where none was tried.
RgbImage outcome_colours(const ReuseMaps& maps);

/// How the shifts to a pixel ended, most of them first: "ok 71 %, occluded 20 %, no light 9 %".
std::string outcome_shares(const ReuseCounts& counts);

} // namespace tessera
