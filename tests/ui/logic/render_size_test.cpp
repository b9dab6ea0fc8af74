#include "ui/state/viewer_state.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using Base = SizeChoice::Base;

TEST(RenderSize, FitsThePaneWithTheFilmsAspect) {
    for (const glm::ivec2 pane : {glm::ivec2(583, 670), glm::ivec2(1290, 300), glm::ivec2(97, 1013)}) {
        const glm::ivec2 size = render_size({}, {1280, 720}, pane);
        EXPECT_LE(size.x, pane.x);
        EXPECT_LE(size.y, pane.y);
        EXPECT_GT(size.x, 0.85f * static_cast<float>(std::min(pane.x, pane.y * 16 / 9)));
        EXPECT_NEAR(static_cast<float>(size.y), static_cast<float>(size.x) * 720 / 1280, 1.0f);
    }
}

TEST(RenderSize, FittedWidthsHaveSmallPrimeFactors) {
    for (int width = 1; width < 1500; width += 7) {
        int n = render_size({}, {100, 100}, {width, 5000}).x;
        for (int factor : {2, 3, 5}) {
            while (n % factor == 0)
                n /= factor;
        }
        EXPECT_EQ(n, 1) << width;
    }
}

TEST(RenderSize, SceneAndCustomSizesAreExact) {
    EXPECT_EQ(render_size({Base::scene, 1, {}}, {1279, 719}, {50, 50}), glm::ivec2(1279, 719));
    EXPECT_EQ(render_size({Base::scene, 0.5f, {}}, {1280, 720}, {50, 50}), glm::ivec2(640, 360));
    EXPECT_EQ(render_size({Base::custom, 1, {33, 44}}, {1280, 720}, {50, 50}), glm::ivec2(33, 44));
}

TEST(RenderSize, IsNeverEmptyOrTooLarge) {
    EXPECT_EQ(render_size({}, {0, 0}, {0, 0}), glm::ivec2(1, 1));
    EXPECT_EQ(render_size({}, {1920, 1080}, {1, 1}), glm::ivec2(1, 1));
    EXPECT_EQ(render_size({Base::custom, 1, {-5, 0}}, {1, 1}, {1, 1}), glm::ivec2(1, 1));
    const glm::ivec2 huge = render_size({Base::custom, 2, {1 << 28, 1 << 28}}, {1, 1}, {1, 1});
    EXPECT_LE(huge.x, most_render_pixels_an_edge);
}

} // namespace
} // namespace tessera
