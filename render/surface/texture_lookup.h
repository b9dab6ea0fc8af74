#pragma once

#include "render/surface/texture.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

// Bitmap look-ups, for texture.cpp and texture_filter.cpp.

namespace tessera {

/// Wraps a coordinate into [0, 1]; returns 0 if it is not finite.
inline float wrap(float t, Wrap mode) {
    switch (mode) {
    case Wrap::repeat:
        t -= std::floor(t);
        break;
    case Wrap::mirror:
        t -= 2 * std::floor(t / 2);
        t = t > 1 ? 2 - t : t;
        break;
    case Wrap::clamp:
        t = glm::clamp(t, 0.0f, 1.0f);
        break;
    }
    return t >= 0 && t <= 1 ? t : 0.0f;
}

/// Wraps a pixel index that is at most one beyond the edge.
inline int wrap(int i, int size, Wrap mode) {
    if (i < 0)
        return mode == Wrap::repeat ? size - 1 : 0;
    if (i >= size)
        return mode == Wrap::repeat ? 0 : size - 1;
    return i;
}

inline Rgb nearest(const Bitmap& bitmap, glm::vec2 uv) {
    const int x = static_cast<int>(uv.x * static_cast<float>(bitmap.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(bitmap.height));
    return bitmap.texel(glm::min(x, bitmap.width - 1), glm::min(y, bitmap.height - 1));
}

/// The four pixels around uv and the offset from the upper left one; pixel centres are at (i + 1/2) / size.
struct Corners {
    Rgb upper_left, upper_right, lower_left, lower_right;
    float right, down; // in [0, 1)
};

inline Corners corners(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const float x = uv.x * static_cast<float>(bitmap.width) - 0.5f;
    const float y = uv.y * static_cast<float>(bitmap.height) - 0.5f;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const int x0 = wrap(static_cast<int>(left), bitmap.width, mode);
    const int x1 = wrap(static_cast<int>(left) + 1, bitmap.width, mode);
    const int y0 = wrap(static_cast<int>(top), bitmap.height, mode);
    const int y1 = wrap(static_cast<int>(top) + 1, bitmap.height, mode);
    return {
        bitmap.texel(x0, y0), bitmap.texel(x1, y0), bitmap.texel(x0, y1), bitmap.texel(x1, y1), x - left, y - top};
}

inline Rgb bilinear(const Bitmap& bitmap, glm::vec2 uv, Wrap mode) {
    const Corners c = corners(bitmap, uv, mode);
    return glm::mix(glm::mix(c.upper_left, c.upper_right, c.right), glm::mix(c.lower_left, c.lower_right, c.right),
                    c.down);
}

inline Rgb look_up(const BitmapTexture& texture, glm::vec2 uv) {
    const Bitmap& bitmap = *texture.bitmap;
    uv = {wrap(uv.x, texture.wrap), wrap(uv.y, texture.wrap)};
    return texture.filter == Filter::nearest ? nearest(bitmap, uv) : bilinear(bitmap, uv, texture.wrap);
}

} // namespace tessera
