#pragma once

#include "tests/ui/viewer_harness.h"

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

/// PT and G-PR at rest, with pictures of equal size.
struct Panes : testing::Test, ViewerHarness {
    Panes() { rest(3); }

    glm::vec3 colour(const ScreenPixels& pixels, glm::vec2 at) const {
        const std::uint8_t* p = pixels.at(static_cast<int>(at.x), static_cast<int>(at.y));
        return {p[0], p[1], p[2]};
    }
    /// Returns a point of a pane's picture, given as fractions of its area.
    glm::vec2 point(int index, float x, float y) const {
        const ControlRect rect = place("pane" + std::to_string(index) + ".picture");
        return glm::floor(rect.min + (rect.max - rect.min) * glm::vec2(x, y)) + 0.5f;
    }
    /// Returns the centre of a pixel of a pane's image.
    glm::vec2 middle_of(int index, int x, int y) {
        const glm::ivec2 size = state().request_size();
        const Placement placement = state().display.view.place(size, pane(index).canvas_size);
        return place("pane" + std::to_string(index) + ".picture").min + placement.origin +
               (glm::vec2(x, y) + 0.5f) * placement.extent / glm::vec2(size);
    }
    /// Returns the mean colour distance between columns of two panes.
    float distance(int a, int b, float x, const ScreenPixels& pixels) const {
        float sum = 0;
        for (int i = 0; i < 20; ++i) {
            const float y = 0.35f + 0.015f * static_cast<float>(i);
            sum += glm::distance(colour(pixels, point(a, x, y)), colour(pixels, point(b, x, y)));
        }
        return sum / 20;
    }
    void wait_for_settled() {
        wait_until([&] { return viewer.settled(3); });
        frames(2);
    }
};

} // namespace tessera::test
