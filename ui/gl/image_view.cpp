#include "ui/gl/image_view.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Returns the pane pixels for each image pixel at which the whole picture fits. An image that nearly fills the
/// pane is shown pixel by pixel, without scaling.
float fitting_scale(glm::ivec2 image_size, glm::ivec2 pane_size) {
    const glm::vec2 ratio = glm::vec2(pane_size) / glm::vec2(image_size);
    const float scale = std::min(ratio.x, ratio.y);
    return scale >= 1.0f && scale < 1.15f ? 1.0f : scale;
}

bool is_degenerate(glm::ivec2 image_size, glm::ivec2 pane_size) {
    return image_size.x < 1 || image_size.y < 1 || pane_size.x < 1 || pane_size.y < 1;
}

} // namespace

ImageView::ImageView(float zoom, glm::vec2 center)
    : zoom_(std::clamp(zoom, least_zoom, most_zoom)), center_(glm::clamp(center, glm::vec2(0), glm::vec2(1))) {}

Placement ImageView::place(glm::ivec2 image_size, glm::ivec2 pane_size) const {
    if (is_degenerate(image_size, pane_size))
        return {};
    const glm::vec2 extent = glm::vec2(image_size) * (fitting_scale(image_size, pane_size) * zoom_);
    return {glm::round(glm::vec2(pane_size) * 0.5f - center_ * extent), extent};
}

void ImageView::zoom_at(glm::vec2 pane_pixel, float factor, glm::ivec2 image_size, glm::ivec2 pane_size) {
    if (is_degenerate(image_size, pane_size))
        return;
    const glm::vec2 fixed = place(image_size, pane_size).to_image(pane_pixel);
    zoom_ = std::clamp(zoom_ * factor, least_zoom, most_zoom);
    const glm::vec2 extent = glm::vec2(image_size) * (fitting_scale(image_size, pane_size) * zoom_);
    center_ = fixed + (glm::vec2(pane_size) * 0.5f - pane_pixel) / extent;
    center_ = glm::clamp(center_, glm::vec2(0), glm::vec2(1)); // keeps the picture in sight
}

void ImageView::show(glm::vec2 min, glm::vec2 max, glm::ivec2 image_size, glm::ivec2 pane_size) {
    if (is_degenerate(image_size, pane_size))
        return;
    const glm::vec2 ratio = glm::vec2(pane_size) / glm::max((max - min) * glm::vec2(image_size), glm::vec2(1));
    const float zoom = std::min(ratio.x, ratio.y) / fitting_scale(image_size, pane_size);
    *this = ImageView(zoom, (min + max) * 0.5f);
}

void ImageView::pan(glm::vec2 pixels, glm::ivec2 image_size, glm::ivec2 pane_size) {
    if (is_degenerate(image_size, pane_size))
        return;
    center_ = glm::clamp(center_ - pixels / place(image_size, pane_size).extent, glm::vec2(0), glm::vec2(1));
}

} // namespace tessera
