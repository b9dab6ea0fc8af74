#pragma once

#include <algorithm>

#include <glm/vec2.hpp>

namespace tessera {

/// A rectangle of pixels: first column and row, and one past the last.
struct PixelRect {
    int x0, y0, x1, y1;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    PixelRect clipped(glm::ivec2 size) const {
        return {std::max(x0, 0), std::max(y0, 0), std::min(x1, size.x), std::min(y1, size.y)};
    }
    /// With one more column and row, where the image of that size has them: the neighbours to which forward
    /// gradients lead.
    PixelRect with_halo(glm::ivec2 size) const { return PixelRect{x0, y0, x1 + 1, y1 + 1}.clipped(size); }
    bool operator==(const PixelRect&) const = default;
    bool contains(glm::ivec2 p) const { return p.x >= x0 && p.y >= y0 && p.x < x1 && p.y < y1; }
};

/// Calls `visit(square)` for the squares of a given edge that fill a rectangle, row by row; the last ones are cut
/// off.
template <class Visit>
void for_each_square(PixelRect rect, int edge, Visit&& visit) {
    for (int y = rect.y0; y < rect.y1; y += edge)
        for (int x = rect.x0; x < rect.x1; x += edge)
            visit(PixelRect{x, y, std::min(x + edge, rect.x1), std::min(y + edge, rect.y1)});
}

} // namespace tessera
