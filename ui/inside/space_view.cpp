#include "render/inspect/inspection.h"
#include "ui/inside/drawing.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

namespace {

constexpr ImU32 background = IM_COL32(20, 22, 26, 255), border = IM_COL32(58, 61, 70, 255);
constexpr ImU32 normal_colour = IM_COL32(120, 190, 255, 220), camera_colour = IM_COL32(226, 228, 233, 200);
constexpr ImU32 lamp_colour = IM_COL32(255, 226, 92, 255);
constexpr float field = 40; // field of view in degrees, across the smaller side

/// Returns all points to show: the path, the shifts with light, and what the scene's camera sees.
std::vector<glm::vec3> extent_of(const SpaceSubject& subject, const SpaceView& view) {
    std::vector<glm::vec3> all;
    for (const InspectedVertex& x : subject.path) {
        all.push_back(x.position);
        if (x.light)
            all.push_back(x.light->position);
    }
    for (const InspectedShift* s : subject.shifts)
        if (!is_black(s->value)) {
            all.insert(all.end(), s->offset.begin(), s->offset.end());
            all.insert(all.end(), s->beyond.begin(), s->beyond.end());
        }
    if (!view.surroundings || all.empty())
        return all;
    all.emplace_back(view.surroundings->camera.to_world[3]);
    constexpr std::size_t step = 16;
    for (std::size_t i = 0; i < view.surroundings->points.size(); i += step)
        all.push_back(view.surroundings->points[i]);
    return all;
}

/// Returns how far a camera e must move along one axis of the picture (left or up), and along its view direction
/// `ahead`, so that all points p lie within `slope` of the middle: |p.axis - e.axis| <= slope (p.ahead - e.ahead).
glm::vec2 stand_for(const std::vector<glm::vec3>& points, glm::vec3 axis, glm::vec3 ahead, float slope) {
    float plus = -1e30f, minus = -1e30f;
    for (glm::vec3 p : points) {
        plus = std::max(plus, glm::dot(p, axis) / slope - glm::dot(p, ahead));
        minus = std::max(minus, -glm::dot(p, axis) / slope - glm::dot(p, ahead));
    }
    return {slope * (plus - minus) * 0.5f, -(plus + minus) * 0.5f};
}

/// Moves the view's camera to show all points, keeping its direction; at first from beside the scene's camera and
/// above it.
void fit(const std::vector<glm::vec3>& points, glm::vec2 size, const SpaceSubject& subject, SpaceView& view) {
    const Camera& other =
        view.has_direction || !view.surroundings ? view.camera.camera() : view.surroundings->camera;
    Camera camera{other.to_world, field, FovAxis::smaller};
    for (int axis = 0; axis < 3; ++axis) // this view is always a perspective camera without scale
        camera.to_world[axis] = glm::normalize(camera.to_world[axis]);
    glm::vec3 middle(0);
    for (glm::vec3 p : points)
        middle += p / static_cast<float>(points.size());
    if (!view.has_direction) { // turns around the points
        camera.to_world[3] =
            glm::vec4(middle - subject.scene_radius * glm::normalize(glm::vec3(camera.to_world[2])), 1);
        view.camera.set_home(camera, middle, subject.scene_radius);
        view.camera.orbit({-0.3f, 0.13f}, 1);
        camera = view.camera.camera();
    }
    view.has_direction = view.has_direction || view.surroundings;
    view.fits = false;
    const auto axis = [&](int i) { return glm::normalize(glm::vec3(camera.to_world[i])); };
    constexpr float used = 0.8f; // of the picture, to leave room for names beside points
    const glm::vec2 slope = used * std::tan(glm::radians(field * 0.5f)) * size / std::min(size.x, size.y);
    const glm::vec2 left = stand_for(points, axis(0), axis(2), slope.x),
                    up = stand_for(points, axis(1), axis(2), slope.y);
    const float least = 0.05f * subject.scene_radius;
    const float ahead = std::min({left.y, up.y, glm::dot(middle, axis(2)) - least});
    camera.to_world[3] = glm::vec4(left.x * axis(0) + up.x * axis(1) + ahead * axis(2), 1);
    view.camera.set_home(camera, middle, subject.scene_radius);
}

void use_mouse(const ScreenRect& rect, SpaceView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 moved(io.MouseDelta.x, io.MouseDelta.y), size = rect.size();
    if (ImGui::IsItemHovered() && io.MouseWheel != 0)
        view.camera.dolly(std::pow(0.88f, io.MouseWheel));
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        view.fits = true;
    if (!ImGui::IsItemActive() || moved == glm::vec2(0))
        return;
    const glm::vec2 at(io.MousePos.x - rect.min.x, io.MousePos.y - rect.min.y);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || io.KeyShift)
        view.camera.pan(at - moved, at, glm::ivec2(size));
    else if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
        view.camera.orbit(moved, size.y);
}

void draw_surroundings(const SceneLines& lines, const Surroundings& around) {
    const float width = std::max(std::floor(ImGui::GetFontSize() * 0.12f), 1.0f);
    for (std::size_t i = 0; i < around.points.size(); ++i) {
        const Rgb c = 40.0f + 110.0f * glm::clamp(around.albedo[i], Rgb(0), Rgb(1));
        lines.dot(around.points[i], IM_COL32(int(c.r), int(c.g), int(c.b), 150), width);
    }
    for (glm::vec3 lamp : around.lamps) {
        lines.point(lamp, lamp_colour, ImGui::GetFontSize() * 0.2f);
        lines.point(lamp, background, ImGui::GetFontSize() * 0.1f);
    }
}

/// Draws edges from the camera through the corners of its picture: a pyramid, or a box if rays are parallel.
void draw_camera(const SceneLines& lines, const Surroundings& around, float length) {
    const Projection projection(around.camera, around.size);
    const glm::vec2 size(around.size);
    const glm::vec2 corners[] = {{0, 0}, {size.x, 0}, size, {0, size.y}};
    const auto along = [&](int i, float distance) {
        const Ray ray = projection.ray(corners[i % 4]);
        return ray.origin + distance * ray.direction;
    };
    const float width = ImGui::GetFontSize() * 0.08f;
    for (int i = 0; i < 4; ++i) {
        lines.line(along(i, 0), along(i, length), camera_colour, width);
        lines.line(along(i, length), along(i + 1, length), camera_colour, width);
    }
    lines.name(along(0, 0), "camera", camera_colour);
}

/// Returns the origin of the camera ray to a point, through the middle of the lens.
glm::vec3 eye_toward(const Surroundings& around, glm::vec3 point) {
    const Projection projection(around.camera, around.size);
    const glm::vec4 seen = projection.project(point);
    return projection.ray(glm::vec2(seen) / seen.w).origin;
}

void draw_normals(const SceneLines& lines, const std::vector<InspectedVertex>& path, float length) {
    for (const InspectedVertex& x : path)
        lines.line(x.position, x.position + length * x.normal, normal_colour, ImGui::GetFontSize() * 0.1f);
}

void draw_scene(const PictureFrame& frame, const SpaceSubject& subject, const SpaceView& view) {
    const SceneLines lines(frame, view.camera.camera(), glm::ivec2(glm::max(frame.rect.size(), glm::vec2(1))),
                           1e-4f * subject.scene_radius);
    const float size = 0.12f * std::max(view.camera.distance(), 1e-3f * subject.scene_radius);
    if (view.surroundings) {
        draw_surroundings(lines, *view.surroundings);
        draw_camera(lines, *view.surroundings, size);
        if (!subject.path.empty())
            lines.line(eye_toward(*view.surroundings, subject.path.front().position),
                       subject.path.front().position, with_alpha(camera_colour, 0.8f),
                       ImGui::GetFontSize() * 0.1f);
    }
    draw_shifts(lines, subject.shifts, subject.marked);
    draw_normals(lines, subject.path, size * 0.6f);
    draw_base_path(lines, subject.path, 0.5f * subject.scene_radius);
}

} // namespace

void draw_space_view(glm::vec2 size, const SpaceSubject& subject, SpaceView& view, Controls& controls) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    PictureFrame frame;
    frame.rect = {{at.x, at.y}, glm::vec2(at.x, at.y) + glm::max(size, glm::vec2(1))};
    frame.placement = {glm::vec2(0), frame.rect.size()};
    ImGui::InvisibleButton("space", {frame.rect.size().x, frame.rect.size().y},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    controls.place(
        "space",
        "The base path (white), its shifts (colours of their outcomes), normals (blue), "
        "emitters (yellow), footprints (violet), and the scene as points. Drag to rotate, with Shift to move; "
        "scroll to zoom; double-click to show all.");
    if (view.fits)
        if (const std::vector<glm::vec3> extent = extent_of(subject, view); !extent.empty())
            fit(extent, frame.rect.size(), subject, view);
    const bool has_fitted = !view.fits;
    use_mouse(frame.rect, view);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 max(frame.rect.max.x, frame.rect.max.y);
    list.AddRectFilled(at, max, background);
    list.PushClipRect(at, max, true);
    if (has_fitted)
        draw_scene(frame, subject, view);
    list.PopClipRect();
    list.AddRect(at, max, border);
}

} // namespace tessera
