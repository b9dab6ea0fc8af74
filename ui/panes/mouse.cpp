#include "render/run/first_hits.h"
#include "render/scene/scene.h"
#include "ui/panes/pane_parts.h"

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr float zoom_a_notch = 1.25f;
constexpr float dolly_a_notch = 0.88f;
constexpr float dolly_a_pane = 6.0f; // a right drag over the pane's height multiplies the distance by e^6

void drag_picture(const PaneMouse& mouse, glm::ivec2 image_size, glm::ivec2 pane_size, ViewerState& state) {
    state.display.view.pan(mouse.position - mouse.previous, image_size, pane_size);
}

void drag_camera(const PaneMouse& mouse, const Placement& placement, glm::ivec2 image_size, glm::ivec2 pane_size,
                 ViewerState& state) {
    const glm::vec2 moved = mouse.position - mouse.previous;
    const float height = static_cast<float>(pane_size.y);
    if (mouse.middle || (mouse.left && mouse.shift)) {
        const glm::vec2 size(image_size);
        state.camera.pan(placement.to_image(mouse.previous) * size, placement.to_image(mouse.position) * size,
                         image_size);
    } else if (mouse.right) {
        state.camera.dolly(std::exp(moved.y * dolly_a_pane / height));
    } else if (mouse.left) {
        state.camera.orbit(moved, height);
    }
}

} // namespace

void apply_mouse(const PaneMouse& mouse, const Placement& placement, glm::ivec2 image_size, glm::ivec2 pane_size,
                 ViewerState& state) {
    if (placement.extent.x <= 0 || placement.extent.y <= 0)
        return;
    if (mouse.wheel != 0 && mouse.ctrl)
        state.display.view.zoom_at(mouse.position, std::pow(zoom_a_notch, mouse.wheel), image_size, pane_size);
    else if (mouse.wheel != 0)
        state.camera.dolly(std::pow(dolly_a_notch, mouse.wheel));

    if (mouse.position == mouse.previous)
        return;
    if (mouse.left && mouse.ctrl)
        drag_picture(mouse, image_size, pane_size, state);
    else
        drag_camera(mouse, placement, image_size, pane_size, state);
}

std::optional<glm::vec3> point_under(glm::vec2 place, const PictureFrame& frame, const ViewerState& state) {
    const glm::vec2 at = frame.placement.to_image(place);
    if (!state.scene || at.x < 0 || at.y < 0 || at.x > 1 || at.y > 1)
        return {};
    const glm::ivec2 size = state.request_size();
    const Camera& camera = state.camera.camera();
    const float distance = first_hit_distance(*state.scene, camera, at * glm::vec2(size), size);
    if (distance <= 0)
        return {};
    const Ray ray = camera.ray(at * glm::vec2(size), size);
    return ray.origin + distance * ray.direction;
}

glm::vec2 mouse_position() {
    return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
}

glm::vec2 grab_position() {
    const ImGuiIO& io = ImGui::GetIO();
    for (int button = 0; button < 3; ++button)
        if (ImGui::IsMouseClicked(button))
            return {io.MouseClickedPos[button].x, io.MouseClickedPos[button].y};
    return mouse_position();
}

PaneMouse read_mouse(const PictureFrame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    PaneMouse mouse;
    const glm::vec2 before = ImGui::IsItemActivated()
                                 ? grab_position()
                                 : mouse_position() - glm::vec2(io.MouseDelta.x, io.MouseDelta.y);
    mouse.position = (mouse_position() - frame.rect.min) * frame.pixels_a_unit;
    mouse.previous = (before - frame.rect.min) * frame.pixels_a_unit;
    const bool active = ImGui::IsItemActive();
    mouse.left = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    mouse.middle = active && ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    mouse.right = active && ImGui::IsMouseDown(ImGuiMouseButton_Right);
    mouse.wheel = ImGui::IsItemHovered() ? io.MouseWheel : 0.0f;
    mouse.ctrl = io.KeyCtrl;
    mouse.shift = io.KeyShift;
    return mouse;
}

} // namespace tessera
