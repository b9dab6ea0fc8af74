#include "tests/ui/viewer_harness.h"

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

TEST(TextScaleAndTheme, KeysScaleTextUpToThreeHundredPercent) {
    ViewerHarness h({1920, 1200});
    h.frames(2);
    const float before = h.place("tile").max.y - h.place("tile").min.y;
    for (int i = 0; i < 20; ++i)
        h.type(Key::up, true);
    h.frames(2);
    EXPECT_EQ(h.state().layout.ui_scale(), 3);
    EXPECT_NEAR(h.place("tile").max.y - h.place("tile").min.y, before * 3, 4);
    for (int i = 0; i < 20; ++i)
        h.type(Key::down, true);
    h.frames(2);
    EXPECT_EQ(h.state().layout.ui_scale(), 1);
}

TEST(TextScaleAndTheme, TextScaleIsRelativeToTheDisplay) {
    ViewerHarness h({1920, 1200}, 1.5f);
    h.frames(2);
    EXPECT_EQ(h.state().layout.ui_scale(), 1.5f);
    h.type(Key::up, true);
    EXPECT_EQ(h.state().layout.ui_scale(), 1.75f);
    h.scale_ = 1; // the window moves to another display
    h.frames(2);
    EXPECT_NEAR(h.state().layout.ui_scale(), 1.75f / 1.5f, 1e-5f);
    h.type(Key::digit0, true);
    EXPECT_EQ(h.state().layout.ui_scale(), 1);
}

TEST(TextScaleAndTheme, ThemesAreDarkAndLight) {
    ViewerHarness h;
    h.load_scene();
    h.state().rendering.paused = true;
    h.frames(3);
    const auto lightness_of = [&](glm::vec2 at) {
        const ScreenPixels pixels = h.screen();
        return pixels.at(static_cast<int>(at.x), static_cast<int>(at.y))[1];
    };
    const ControlRect first = h.place("restart"), picture = h.place("pane1.picture");
    const glm::vec2 panel(first.min.x - 4, first.max.y + 2);
    const double before = h.brightness("pane1.picture");
    EXPECT_LT(lightness_of(panel), 40);
    h.type(Key::f9);
    h.frames(2);
    EXPECT_EQ(h.state().layout.theme, Theme::light);
    EXPECT_GT(lightness_of(panel), 230);
    EXPECT_EQ(h.place("pane1.picture"), picture);          // the same positions
    EXPECT_NEAR(h.brightness("pane1.picture"), before, 1); // and the same pictures
    h.state().layout.show_statistics = true;
    h.frames(3);
    h.save("light.png");
    h.type(Key::f1);
    h.save("light-help.png");
    h.type(Key::f1);
    h.type(Key::f9);
    h.frames(2);
    EXPECT_LT(lightness_of(panel), 40);
}

} // namespace
} // namespace tessera::test
