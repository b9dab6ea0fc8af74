#pragma once

#include "render/method/inspection.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace tessera {

/// What a render is made of: enough to take its samples again, whatever is on show by now.
struct PassOrigin {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    glm::ivec2 size{0};
    RenderSettings settings;
    std::shared_ptr<const ReusePlan> plan{}; ///< of the pass; null: it is to be learnt again
    std::uint64_t generation = 0;            ///< of the request; 0: no pane's
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
    int slot = 0;                 ///< of the pane whose it is, if that still shows the request, ...
    std::uint64_t generation = 0; ///< ... and of which request

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

/// What the dialog for a sample asks for.
struct SampleForm {
    bool show = false;
    glm::ivec2 pixel{0};
    int pass = 0;
    std::uint64_t seed = 0;
};

} // namespace tessera
