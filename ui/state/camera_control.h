#pragma once

#include "render/scene/camera.h"

#include <filesystem>
#include <optional>

#include <glm/vec3.hpp>

namespace tessera {

/// A view to come back to.
struct Bookmark {
    Camera camera;
    float distance = 0; ///< to its target

    bool operator==(const Bookmark&) const = default;
};

/// Moves a camera with the mouse and the keys: around, past and toward a target that lies ahead of it. Movements
/// are rigid, so that whatever the camera's matrix holds beside them (a mirror, a scale) stays.
class CameraControl {
public:
    /// Takes a scene's camera as the place to come back to. The target is as far ahead as the scene's centre; "up"
    /// is the axis of the world nearest to the camera's own.
    void set_home(const Camera& camera, glm::vec3 scene_center, float scene_radius);
    void go_home();

    /// Takes another camera, with its distance to the target; 0: as far ahead as the scene's centre. The place to
    /// come back to stays.
    void put(const Camera& camera, float distance);

    const Camera& camera() const { return camera_; }
    glm::vec3 position() const;
    glm::vec3 forward() const; ///< unit
    glm::vec3 target() const { return position() + distance_ * forward(); }
    float distance() const { return distance_; } ///< to the target

    /// What a drag has taken hold of: what orbits turn about and pans keep under the mouse, until the camera is
    /// put or moved otherwise. Its depth is the target's from now on.
    void grab(glm::vec3 point);
    /// Turns where it stands to look at the point, which becomes the target.
    void focus(glm::vec3 point);

    /// Of a perspective, degrees, cut to these limits.
    static constexpr float least_fov = 1, most_fov = 170;
    void set_fov(float degrees);

    /// A drag by `pixels` (right, down) turns the camera about what was grabbed, or the target;
    /// `pixels_a_half_turn` is the drag that leads behind it. Stops short of looking straight up or down.
    void orbit(glm::vec2 pixels, float pixels_a_half_turn);

    /// Moves sideways, so that what the camera sees at `from` at the target's depth is then seen at `to`. Both are
    /// pixels of a picture of `size`.
    void pan(glm::vec2 from, glm::vec2 to, glm::ivec2 size);

    /// Multiplies the distance to the target, which stays; very near, it is pushed ahead. An orthographic camera
    /// sees that much more instead, from where it is.
    void dolly(float factor);

    /// Moves camera and target: to the left, up and ahead, in radii of the scene.
    void fly(glm::vec3 left_up_forward);

    /// Turns the camera where it stands, by radians to the left and upward.
    void look(float left, float up);

private:
    void put_target_at_depth(glm::vec3 point);
    void turn_about(glm::vec3 pivot, float yaw, float pitch);
    void move(glm::vec3 by);
    void widen(float factor);         // what an orthographic camera sees
    float distance_of_center() const; // ahead of the camera, within reason
    float handedness() const;         // -1 for a camera that sees mirrored

    Camera home_;
    Camera camera_;
    glm::vec3 axis_lengths_{1}; // of the camera's matrix
    float home_distance_ = 1;
    float distance_ = 1;
    std::optional<glm::vec3> grabbed_;
    glm::vec3 scene_center_{0};
    float scene_radius_ = 1;
    glm::vec3 up_{0, 1, 0};
};

/// Writes the camera to NAME-camera.json in the folder (empty: the current one), of a scene file NAME.xml (empty:
/// tessera), or to NAME-camera-2.json if that is there, and so on. Returns the file written, in full; throws
/// std::exception that names it.
std::filesystem::path store_camera(const std::filesystem::path& scene_file, const Camera& camera,
                                   const std::filesystem::path& folder = {});

} // namespace tessera
