#pragma once

#include "tests/ui/osmesa_context.h"
#include "ui/gl/canvas.h"
#include "ui/gl/gl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tessera {

using Colour = std::array<int, 3>;

inline int srgb(float c) {
    c = std::min(std::max(c, 0.0f), 1.0f);
    const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(encoded * 255));
}

class CanvasTest : public testing::Test {
protected:
    test::OsmesaContext context_{{16, 16}};
    CanvasShader shader_;
    ImageTexture image_;
    Canvas canvas_;

    /// Returns a view in which the image fills the pane.
    CanvasView filling(glm::ivec2 pane_size) const { return {pane_size, {0, 0}, glm::vec2(pane_size)}; }

    ScreenPixels pixels() const {
        const DrawInto canvas(canvas_.framebuffer());
        return read_screen(canvas_.framebuffer().size());
    }
    ScreenPixels drawn(const CanvasView& view) {
        canvas_.draw(shader_, image_, view);
        return pixels();
    }
    Colour pixel(int x, int y) const {
        const ScreenPixels all = pixels();
        const std::uint8_t* p = all.at(x, y);
        return {p[0], p[1], p[2]};
    }
    void expect_colour(int x, int y, Colour expected, int tolerance = 1) const {
        const Colour seen = pixel(x, y);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(seen[i], expected[i], tolerance) << "channel " << i << " of " << x << ',' << y;
    }
};

inline const Colour magenta{255, 0, 255}, cyan{0, 255, 255};
inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace tessera
