#pragma once

#include "ui/canvas.h"
#include "ui/picture_frame.h"

namespace tessera {

/// How the picture lies in a square of so many framebuffer pixels when enlarged about a place of the image, which
/// is fractions of it.
CanvasView magnified(const CanvasView& view, glm::ivec2 image_size, glm::vec2 place, int pixels);

/// Edge of the magnifier, framebuffer pixels.
int magnifier_pixels(const PictureFrame& frame);

/// Draws the magnifier's rendition over the picture, about a place of the image, with a frame around its pixel.
void draw_magnifier(const PictureFrame& frame, const CanvasView& view, glm::ivec2 image_size, glm::vec2 place,
                    GLuint rendition);

} // namespace tessera
