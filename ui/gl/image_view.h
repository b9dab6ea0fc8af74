#pragma once

#include <glm/vec2.hpp>

namespace tessera {

/// Rectangle on the screen, in screen units.
struct ScreenRect {
    glm::vec2 min{0};
    glm::vec2 max{0};
    glm::vec2 size() const { return max - min; }
    bool contains(glm::vec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
};

/// Position of an image in a pane, in the pane's pixels.
struct Placement {
    glm::vec2 origin{0}; ///< of the image's top left corner
    glm::vec2 extent{0};

    /// Converts pane pixels to fractions of the image: (0,0) is its top left corner, (1,1) its bottom right one.
    glm::vec2 to_image(glm::vec2 pane_pixel) const { return (pane_pixel - origin) / extent; }
};

/// Zoom and pan, shared by all panes and independent of the number of pixels of an image.
class ImageView {
public:
    static constexpr float least_zoom = 0.25f, most_zoom = 256.0f;

    ImageView() = default;
    /// @param center  fraction of the image in the middle of the pane. Both arguments are clamped.
    ImageView(float zoom, glm::vec2 center);

    Placement place(glm::ivec2 image_size, glm::ivec2 pane_size) const;

    /// Zooms by `factor` around a pane pixel, whose image point stays there.
    void zoom_at(glm::vec2 pane_pixel, float factor, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Moves the picture by a number of pane pixels.
    void pan(glm::vec2 pixels, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Shows a part of the image, given as fractions, as large as the pane allows.
    void show(glm::vec2 min, glm::vec2 max, glm::ivec2 image_size, glm::ivec2 pane_size);
    /// Shows the whole picture, centred.
    void fit() { *this = ImageView(); }

    float zoom() const { return zoom_; } ///< 1: the whole picture fits
    glm::vec2 center() const { return center_; }
    bool operator==(const ImageView&) const = default;

private:
    float zoom_ = 1;
    glm::vec2 center_{0.5f};
};

/// Position of a picture on the screen.
struct PictureFrame {
    ScreenRect rect;         ///< area for the picture
    float pixels_a_unit = 1; ///< framebuffer pixels for each screen unit
    glm::ivec2 pixels{1};    ///< size of the area in framebuffer pixels
    Placement placement;     ///< of the picture in the area, framebuffer pixels

    /// Returns the fraction of the image at a point of the screen; to_screen() is its inverse.
    glm::vec2 to_image(glm::vec2 screen) const { return placement.to_image((screen - rect.min) * pixels_a_unit); }
    glm::vec2 to_screen(glm::vec2 place) const {
        return rect.min + (placement.origin + place * placement.extent) / pixels_a_unit;
    }
};

} // namespace tessera
