#pragma once

#include <glm/vec2.hpp>

namespace tessera {

/// Part of the screen, in screen units.
struct ScreenRect {
    glm::vec2 min{0};
    glm::vec2 max{0};
    glm::vec2 size() const { return max - min; }
    bool contains(glm::vec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
};

/// Where an image lies in a pane, in the pane's pixels.
struct Placement {
    glm::vec2 origin{0}; ///< of the image's top left corner
    glm::vec2 extent{0};

    /// From pixels of the pane to fractions of the image: (0,0) is its top left, (1,1) its bottom right corner.
    glm::vec2 to_image(glm::vec2 pane_pixel) const { return (pane_pixel - origin) / extent; }
};

/// Zoom and pan of the picture itself, shared by all panes: independent of an image's number of pixels.
class ImageView {
public:
    static constexpr float least_zoom = 0.25f, most_zoom = 256.0f;

    ImageView() = default;
    /// `center`: the fraction of the image that lies in the middle of the pane; clamped to it, as `zoom` is.
    ImageView(float zoom, glm::vec2 center);

    Placement place(glm::ivec2 image_size, glm::ivec2 pane_size) const;

    /// Enlarges by `factor`; what lies under the pane's pixel stays there.
    void zoom_at(glm::vec2 pane_pixel, float factor, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Moves the picture by so many pixels.
    void pan(glm::vec2 pixels, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Shows a part of the image, fractions of it, as large as the pane allows.
    void show(glm::vec2 min, glm::vec2 max, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Shows the whole picture, in the middle.
    void fit() { *this = ImageView(); }

    float zoom() const { return zoom_; } ///< 1: the whole picture fits
    glm::vec2 center() const { return center_; }
    bool operator==(const ImageView&) const = default;

private:
    float zoom_ = 1;
    glm::vec2 center_{0.5f};
};

/// Where a picture lies on the screen.
struct PictureFrame {
    ScreenRect rect;         ///< the place for it
    float pixels_a_unit = 1; ///< framebuffer pixels a screen unit
    glm::ivec2 pixels{1};    ///< of the place, in the framebuffer
    Placement placement;     ///< of the picture in it, framebuffer pixels

    /// The fraction of the image at a point of the screen; to_screen() is its inverse.
    glm::vec2 to_image(glm::vec2 screen) const { return placement.to_image((screen - rect.min) * pixels_a_unit); }
    glm::vec2 to_screen(glm::vec2 place) const {
        return rect.min + (placement.origin + place * placement.extent) / pixels_a_unit;
    }
};

} // namespace tessera
