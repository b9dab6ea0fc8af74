#include "ui/state/camera_control.h"

#include "render/scene/camera.h"
#include "ui/state/file_names.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace tessera {

namespace {

constexpr float least_distance = 0.02f, most_distance = 1000.0f; // scene radii; not tuned
constexpr float pole_margin = 0.02f; // radians between the view and straight up or down; not tuned

glm::vec3 column(const Camera& camera, int i) {
    return glm::vec3(camera.to_world[i]);
}

glm::vec3 nearest_axis(glm::vec3 v) {
    const glm::vec3 size = glm::abs(v);
    int axis = size.x > size.y ? 0 : 1;
    if (size.z > size[axis])
        axis = 2;
    glm::vec3 result(0);
    result[axis] = v[axis] < 0 ? -1.0f : 1.0f;
    return result;
}

glm::vec3 axis_lengths(const Camera& camera) {
    return {glm::length(column(camera, 0)), glm::length(column(camera, 1)), glm::length(column(camera, 2))};
}

/// Makes the axes orthogonal with the given lengths, because rounding errors add up over thousands of drags.
/// Keeps the handedness.
void straighten(glm::mat4& m, glm::vec3 lengths) {
    const glm::vec3 forward = glm::normalize(glm::vec3(m[2]));
    glm::vec3 left = glm::vec3(m[0]) - forward * glm::dot(forward, glm::vec3(m[0]));
    left = glm::normalize(left);
    glm::vec3 up = glm::cross(forward, left);
    if (glm::dot(up, glm::vec3(m[1])) < 0)
        up = -up;
    m[0] = glm::vec4(left * lengths[0], 0);
    m[1] = glm::vec4(up * lengths[1], 0);
    m[2] = glm::vec4(forward * lengths[2], 0);
}

} // namespace

void CameraControl::set_home(const Camera& camera, glm::vec3 scene_center, float scene_radius) {
    home_ = camera;
    camera_ = camera;
    grabbed_.reset();
    axis_lengths_ = axis_lengths(camera);
    scene_radius_ = scene_radius > 0 ? scene_radius : 1.0f;
    up_ = nearest_axis(column(camera, 1));
    scene_center_ = scene_center;
    home_distance_ = distance_of_center();
    distance_ = home_distance_;
}

void CameraControl::put(const Camera& camera, float distance) {
    grabbed_.reset();
    camera_ = camera;
    axis_lengths_ = axis_lengths(camera);
    distance_ = distance > 0 ? std::clamp(distance, least_distance * scene_radius_, most_distance * scene_radius_)
                             : distance_of_center();
}

void CameraControl::go_home() {
    grabbed_.reset();
    camera_ = home_;
    axis_lengths_ = axis_lengths(home_);
    distance_ = home_distance_;
}

float CameraControl::distance_of_center() const {
    const float ahead = glm::dot(scene_center_ - position(), forward());
    return std::clamp(ahead, 0.1f * scene_radius_, 100.0f * scene_radius_);
}

glm::vec3 CameraControl::position() const {
    return column(camera_, 3);
}
glm::vec3 CameraControl::forward() const {
    return glm::normalize(column(camera_, 2));
}

void CameraControl::turn_about(glm::vec3 pivot, float yaw, float pitch) {
    // The pitch axis is horizontal, also for a mirrored or rolled camera.
    const glm::vec3 level = glm::cross(up_, forward());
    const glm::vec3 axis = glm::length(level) > 1e-4f ? glm::normalize(level) : glm::normalize(column(camera_, 0));
    const float angle = std::acos(std::clamp(glm::dot(forward(), up_), -1.0f, 1.0f)); // from straight up
    // A camera nearer to a pole than the margin can stay there, but not come nearer.
    const float lowest = std::min(pole_margin, angle);
    const float highest = std::max(glm::pi<float>() - pole_margin, angle);
    pitch = std::clamp(angle + pitch, lowest, highest) - angle;

    glm::mat4 turn = glm::translate(glm::mat4(1), pivot);
    turn = glm::rotate(turn, yaw, up_);
    turn = glm::rotate(turn, pitch, axis);
    turn = glm::translate(turn, -pivot);
    camera_.to_world = turn * camera_.to_world;
    straighten(camera_.to_world, axis_lengths_);
}

float CameraControl::handedness() const {
    const glm::mat3 axes(camera_.to_world);
    return glm::determinant(axes) < 0 ? -1.0f : 1.0f;
}

void CameraControl::put_target_at_depth(glm::vec3 point) {
    const float ahead = glm::dot(point - position(), forward());
    distance_ = std::clamp(ahead, least_distance * scene_radius_, most_distance * scene_radius_);
}

void CameraControl::grab(glm::vec3 point) {
    grabbed_ = point;
    put_target_at_depth(point);
}

void CameraControl::focus(glm::vec3 point) {
    const glm::vec3 to_point = point - position();
    if (glm::length(to_point) < 1e-6f * scene_radius_)
        return;
    const glm::vec3 wanted = glm::normalize(to_point);
    const auto level = [&](glm::vec3 v) { return v - up_ * glm::dot(v, up_); };
    const auto from_up = [&](glm::vec3 v) { return std::acos(std::clamp(glm::dot(v, up_), -1.0f, 1.0f)); };
    const glm::vec3 now = level(forward()), then = level(wanted);
    const float yaw = std::atan2(glm::dot(up_, glm::cross(now, then)), glm::dot(now, then));
    turn_about(position(), yaw, from_up(wanted) - from_up(forward()));
    grabbed_.reset();
    put_target_at_depth(point);
}

void CameraControl::set_fov(float degrees) {
    camera_.fov = std::clamp(degrees, least_fov, most_fov);
}

void CameraControl::orbit(glm::vec2 pixels, float pixels_a_half_turn) {
    const glm::vec2 angle = pixels * (glm::pi<float>() / std::max(pixels_a_half_turn, 1.0f));
    const glm::vec3 pivot = grabbed_.value_or(target());
    turn_about(pivot, -angle.x * handedness(), angle.y);
    if (!grabbed_)
        move(pivot - target()); // keeps the target in place despite rounding
}

void CameraControl::pan(glm::vec2 from, glm::vec2 to, glm::ivec2 size) {
    if (size.x < 1 || size.y < 1)
        return;
    const auto at_target = [&](glm::vec2 pixel) {
        const Ray ray = camera_.ray(pixel, size);
        return ray.origin + ray.direction * (distance_ / std::max(glm::dot(ray.direction, forward()), 1e-3f));
    };
    move(at_target(from) - at_target(to));
}

void CameraControl::dolly(float factor) {
    grabbed_.reset();
    if (camera_.is_orthographic)
        return widen(factor);
    const float wanted = std::min(distance_ * factor, most_distance * scene_radius_);
    move(forward() * (distance_ - wanted));
    distance_ = std::max(wanted, least_distance * scene_radius_);
}

void CameraControl::widen(float factor) {
    const float width = axis_lengths_.x;
    factor = std::clamp(width * factor, least_distance * scene_radius_, most_distance * scene_radius_) / width;
    for (const int axis : {0, 1}) {
        camera_.to_world[axis] *= factor;
        axis_lengths_[axis] *= factor;
    }
}

void CameraControl::fly(glm::vec3 left_up_forward) {
    grabbed_.reset();
    const glm::vec3 step = left_up_forward * scene_radius_;
    move(glm::normalize(column(camera_, 0)) * step.x + glm::normalize(column(camera_, 1)) * step.y +
         forward() * step.z);
}

void CameraControl::look(float left, float up) {
    grabbed_.reset();
    turn_about(position(), left * handedness(), -up);
}

void CameraControl::move(glm::vec3 by) {
    camera_.to_world[3] += glm::vec4(by, 0);
}

std::filesystem::path store_camera(const std::filesystem::path& scene_file, const Camera& camera,
                                   const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    const std::string stem = scene_file.empty() ? "tessera" : scene_file.stem().string();
    const fs::path file =
        unused_name((folder.empty() ? fs::current_path() : folder) / (stem + "-camera"), ".json");
    write_camera(file, camera);
    return file;
}

} // namespace tessera
