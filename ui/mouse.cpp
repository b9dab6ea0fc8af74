#include "ui/mouse.h"

#include <cmath>

namespace tessera {

namespace {

constexpr float zoom_a_notch = 1.25f;
constexpr float dolly_a_notch = 0.88f;
constexpr float dolly_a_pane = 6.0f; // right drag over the pane's height: distance times e^6

void drag_picture(const PaneMouse& mouse, glm::ivec2 image_size, glm::ivec2 pane_size, ViewerState& state) {
    state.view.pan(mouse.position - mouse.previous, image_size, pane_size);
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
        state.view.zoom_at(mouse.position, std::pow(zoom_a_notch, mouse.wheel), image_size, pane_size);
    else if (mouse.wheel != 0)
        state.camera.dolly(std::pow(dolly_a_notch, mouse.wheel));

    if (mouse.position == mouse.previous)
        return;
    if (mouse.left && mouse.ctrl)
        drag_picture(mouse, image_size, pane_size, state);
    else
        drag_camera(mouse, placement, image_size, pane_size, state);
}

} // namespace tessera
