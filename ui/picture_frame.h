#pragma once

#include "ui/image_view.h"
#include "ui/screen_rect.h"

namespace tessera {

/// Where a picture lies on the screen.
struct PictureFrame {
    ScreenRect rect;         ///< the place for it
    float pixels_a_unit = 1; ///< framebuffer pixels a screen unit
    glm::ivec2 pixels{1};    ///< of the place, in the framebuffer
    Placement placement;     ///< of the picture in it, framebuffer pixels

    /// Between points of the screen and fractions of the image.
    glm::vec2 to_image(glm::vec2 screen) const { return placement.to_image((screen - rect.min) * pixels_a_unit); }
    glm::vec2 to_screen(glm::vec2 place) const {
        return rect.min + (placement.origin + place * placement.extent) / pixels_a_unit;
    }
};

} // namespace tessera
