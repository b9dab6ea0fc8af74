// Keys while a list or a menu is open, and values typed into sliders.

#include "tests/ui/viewer_harness.h"

#include <cstdint>

#include <gtest/gtest.h>
#include <imgui.h>

namespace tessera::test {
namespace {

struct OpenList : testing::Test, ViewerHarness {
    OpenList() {
        rest(2);
        camera = state().camera.camera();
    }
    bool is_open() const { return has("pane0.method/pt"); }
    void open() {
        click_at("pane0.method", 0.3f);
        ASSERT_TRUE(is_open());
    }
    void key(Key key) {
        type(key);
        frames(6);
    }

    Camera camera;
};

TEST_F(OpenList, EscapeClosesOnlyTheList) {
    open();
    state().layout.show_help = false;
    key(Key::escape);
    EXPECT_FALSE(is_open());
    EXPECT_EQ(pane(0).settings.render.method, Method::pt);
    EXPECT_FALSE(state().wishes.cancel_scene);
}

TEST_F(OpenList, ArrowsSelectAndReturnAccepts) {
    const std::uint64_t generation = pane(1).generation;
    open();
    key(Key::down);
    key(Key::down);
    EXPECT_TRUE(is_open());
    EXPECT_TRUE(state().camera.camera() == camera) << "arrows move the camera only if no list is open";
    key(Key::enter);
    EXPECT_FALSE(is_open());
    EXPECT_NE(pane(0).settings.render.method, Method::pt);
    EXPECT_EQ(pane(1).generation, generation) << "the other pane's render restarts";
    EXPECT_TRUE(state().camera.camera() == camera);
}

TEST_F(OpenList, ArrowsBeginAtTheChosenItem) {
    click_at("pane1.method", 0.3f);
    ASSERT_TRUE(has("pane1.method/gpr"));
    frames(3);
    key(Key::up);
    key(Key::enter);
    EXPECT_EQ(pane(1).settings.render.method, Method::gpt);
}

TEST_F(OpenList, HeldArrowsDoNotMoveTheCamera) {
    open();
    viewer.keyboard().press(Key::down, Key::down, false, false);
    frames(10);
    viewer.keyboard().release(Key::down);
    EXPECT_TRUE(state().camera.camera() == camera);
}

TEST_F(OpenList, BlocksShortcuts) {
    open();
    const std::uint64_t generation = pane(0).generation;
    for (Key scene_key : {Key::r, Key::m, Key::p, Key::space, Key::k, Key::j})
        key(scene_key);
    EXPECT_EQ(pane(0).generation, generation);
    EXPECT_FALSE(state().rendering.paused);
    EXPECT_TRUE(state().layout.show_panel);
    EXPECT_FALSE(state().slow_motion.active);
    EXPECT_TRUE(state().messages.empty());
}

TEST_F(OpenList, MenusHandleTheKeysToo) {
    click("menu View");
    ASSERT_TRUE(has("menu View/Brighter"));
    const float exposure = state().display.tone.exposure;
    key(Key::down);
    key(Key::enter);
    EXPECT_FALSE(has("menu View/Brighter"));
    EXPECT_NE(state().display.tone.exposure, exposure);
    click("menu View");
    key(Key::escape);
    EXPECT_FALSE(has("menu View/Brighter"));
}

TEST_F(OpenList, ATypedSliderValueIsSetWhenItLosesFocus) {
    const std::uint64_t generation = pane(1).generation;
    const int before = pane(1).settings.render.tile;
    reveal("tile");
    modifiers(true, false);
    click(place("tile").center());
    modifiers(false, false);
    frames(2);
    for (char digit : {'9', '9'}) {
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(digit));
        frames(3);
        EXPECT_EQ(pane(1).settings.render.tile, before) << "a digit does not set the value";
        EXPECT_EQ(pane(1).generation, generation);
    }
    click(place("pane0.status").center()); // leaves the slider
    frames(3);
    EXPECT_EQ(pane(1).settings.render.tile, 16) << "the maximum";
    EXPECT_NE(pane(1).generation, generation);
}

} // namespace
} // namespace tessera::test
