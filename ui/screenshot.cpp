#include "ui/screenshot.h"

#include <algorithm>

#include <glad/gl.h>

namespace tessera {

ScreenPixels read_screen(glm::ivec2 size) {
    ScreenPixels pixels{size, {}};
    const std::size_t stride = 3 * static_cast<std::size_t>(size.x);
    pixels.rgb.resize(stride * static_cast<std::size_t>(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.rgb.data());
    // OpenGL's first row is the lowest.
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(size.y); top + 1 < bottom; ++top) {
        --bottom;
        std::swap_ranges(pixels.rgb.begin() + static_cast<std::ptrdiff_t>(top * stride),
                         pixels.rgb.begin() + static_cast<std::ptrdiff_t>((top + 1) * stride),
                         pixels.rgb.begin() + static_cast<std::ptrdiff_t>(bottom * stride));
    }
    return pixels;
}

} // namespace tessera
