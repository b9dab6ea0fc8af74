#pragma once

#include "render/method/inspection.h"
#include "ui/camera_control.h"
#include "ui/controls.h"
#include "ui/screen_rect.h"

#include <memory>
#include <vector>

namespace tessera {

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
    bool looked = false;                              ///< it has a direction to look in
    std::shared_ptr<const Surroundings> surroundings; ///< null: none yet

    /// Is to look where another camera does, from where it then sees the whole path.
    void look_as(const Camera& other) {
        camera.put(other, 1);
        fits = looked = true;
    }
};

/// What it shows.
struct SpaceSubject {
    const std::vector<InspectedVertex>& path;
    std::vector<const InspectedShift*> shifts;
    int marked = -1; ///< the shift that stands out
    float scene_radius = 1;
};

/// Draws it into the current window, where the cursor is, as an item "space": a drag turns it, a drag with Shift
/// or the middle button moves it, the wheel comes nearer, a double click shows the whole path.
void draw_space_view(glm::vec2 size, const SpaceSubject& subject, SpaceView& view, Controls& controls);

} // namespace tessera
