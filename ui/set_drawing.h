#pragma once

#include "render/method/inspection.h"
#include "ui/picture_frame.h"

#include <imgui.h>

namespace tessera {

/// Draws pixels of an image over its picture, into the current window.
class SetDrawing {
public:
    SetDrawing(const PictureFrame& frame, glm::ivec2 image_size) : frame_(frame), size_(image_size) {}

    float unit() const; ///< edge of a pixel, screen units
    ImVec2 corner(glm::ivec2 pixel) const;
    ImVec2 middle(glm::ivec2 pixel) const;

    void fill(glm::ivec2 pixel, ImU32 colour) const;
    void fill(PixelRect rect, ImU32 colour) const;
    /// The edges of one pixel, within it.
    void frame(glm::ivec2 pixel, ImU32 colour, float width) const;
    void outline(PixelRect rect, ImU32 colour, float width) const;
    /// Around all pixels of the set that are its border, or all that are not.
    void outline(const InspectedSet& set, bool border, ImU32 colour, float width) const;
    /// From one pixel's middle toward another's, a share of the way.
    void arrow(glm::ivec2 from, glm::ivec2 to, float share, ImU32 colour, float width) const;

private:
    const PictureFrame& frame_;
    glm::ivec2 size_;
};

namespace set_colours {
inline constexpr ImU32 inner = IM_COL32(64, 196, 178, 255), border = IM_COL32(255, 168, 51, 255);
}

} // namespace tessera
