#pragma once

#include "render/scene/camera.h"

#include <filesystem>
#include <optional>

#include <glm/vec3.hpp>

namespace tessera {

/// A stored view.
struct Bookmark {
    Camera camera;
    float distance = 0; ///< to the target, scene units

    bool operator==(const Bookmark&) const = default;
};

/// Moves a camera by mouse and keys, relative to a target that lies ahead of it. Movements are rigid, so that a
/// mirror or scale in the camera's matrix stays; only dolly() of an orthographic camera scales.
class CameraControl {
public:
    /// Sets the camera and the home view. The target is as far ahead as the scene's centre; the up direction is
    /// the world axis nearest to the camera's.
    void set_home(const Camera& camera, glm::vec3 scene_center, float scene_radius);
    void go_home();

    /// Sets the camera and its distance to the target; 0: as far as the scene's centre. The home view stays.
    void put(const Camera& camera, float distance);

    const Camera& camera() const { return camera_; }
    glm::vec3 position() const;
    glm::vec3 forward() const; ///< unit
    glm::vec3 target() const { return position() + distance_ * forward(); }
    float distance() const { return distance_; } ///< to the target

    /// Sets the centre of orbit() until the camera moves in another way. The target takes the point's depth.
    void grab(glm::vec3 point);
    /// Turns the camera in place to look at the point. The target takes its depth.
    void focus(glm::vec3 point);

    /// Limits of the field of view, degrees.
    static constexpr float least_fov = 1, most_fov = 170;
    void set_fov(float degrees);

    /// Turns the camera around the grabbed point or the target by a drag of `pixels` (right, down). A drag of
    /// `pixels_a_half_turn` turns it by 180 degrees. The camera never looks straight up or down.
    void orbit(glm::vec2 pixels, float pixels_a_half_turn);

    /// Moves the camera sideways, so that the point at the target's depth seen at `from` is then seen at `to`.
    /// Both are pixels of a picture of `size`.
    void pan(glm::vec2 from, glm::vec2 to, glm::ivec2 size);

    /// Multiplies the distance to the target by moving the camera. At the minimum distance the target moves ahead
    /// instead. An orthographic camera stays and widens its view by the factor.
    void dolly(float factor);

    /// Moves camera and target left, up and forward, in scene radii.
    void fly(glm::vec3 left_up_forward);

    /// Turns the camera in place, by radians to the left and upward.
    void look(float left, float up);

private:
    void put_target_at_depth(glm::vec3 point);
    void turn_about(glm::vec3 pivot, float yaw, float pitch);
    void move(glm::vec3 by);
    void widen(float factor);         // scales the view of an orthographic camera
    float distance_of_center() const; // depth of the scene's centre, limited to 0.1 to 100 scene radii
    float handedness() const;         // -1 for a mirrored camera, else 1

    Camera home_;
    Camera camera_;
    glm::vec3 axis_lengths_{1}; // lengths of the axes in camera_'s matrix
    float home_distance_ = 1;
    float distance_ = 1;
    std::optional<glm::vec3> grabbed_;
    glm::vec3 scene_center_{0};
    float scene_radius_ = 1;
    glm::vec3 up_{0, 1, 0};
};

/// Writes the camera to the first free name of NAME-camera.json, NAME-camera-2.json, ... in the folder (empty:
/// the current one), where NAME.xml is the scene file (empty: tessera). Returns the path of the file. Throws
/// std::exception, which names the file.
std::filesystem::path store_camera(const std::filesystem::path& scene_file, const Camera& camera,
                                   const std::filesystem::path& folder = {});

} // namespace tessera
