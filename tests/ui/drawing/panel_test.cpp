#include "render/scene/scene.h"
#include "render/settings/settings.h"
#include "tests/ui/viewer_harness.h"

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

/// Drives each control with the mouse and checks the setting.
struct PanelTest : testing::Test, ViewerHarness {
    PanelTest() {
        load_scene();
        state().rendering.paused = true; // only input changes the state
        frames(3);
    }
    const RenderSettings& render(int i) { return pane(i).settings.render; }
};

TEST_F(PanelTest, MethodOfEachPane) {
    for (Method method : all_methods) {
        const std::string name(short_name(method));
        choose("pane0.method", name);
        EXPECT_EQ(render(0).method, method) << name;
        EXPECT_EQ(render(1).method, Method::gpr);
    }
    choose("pane1.method", "pr");
    EXPECT_EQ(render(1).method, Method::pr);
    EXPECT_EQ(render(0).method, Method::gpr);
}

TEST_F(PanelTest, BufferOfEachPane) {
    for (Buffer buffer :
         {Buffer::dy, Buffer::primal, Buffer::reused, Buffer::dx, Buffer::outcomes, Buffer::reconstruction}) {
        choose("pane1.buffer", std::string(short_name(buffer)));
        EXPECT_EQ(pane(1).settings.buffer, buffer);
        EXPECT_EQ(pane(0).settings.buffer, Buffer::reconstruction);
    }
}

TEST_F(PanelTest, SlidersSetTheirOwnSettingInAllPanes) {
    PaneSettings expected = pane(1).settings;
    const auto check = [&](const char* control) {
        EXPECT_EQ(pane(1).settings, expected) << control;
        EXPECT_EQ(pane(0).settings.render.tile, expected.render.tile) << control;
        EXPECT_EQ(pane(0).settings.render.rr_delta, expected.render.rr_delta) << control;
        EXPECT_EQ(pane(0).settings.reconstruction, expected.reconstruction) << control;
        EXPECT_EQ(render(0).method, Method::pt);
    };
    click_at("tile", 0.99f);
    expected.render.tile = 16;
    check("tile");
    click_at("tile", 0.01f);
    expected.render.tile = 1;
    check("tile");
    click_at("max_depth", 0.99f);
    expected.render.max_depth = 64;
    check("max_depth");
    choose("roulette", "absolute");
    expected.render.roulette = RouletteKind::absolute;
    check("roulette");
    click_at("rr_delta", 0.01f);
    expected.render.rr_delta = 0;
    check("rr_delta");
    click_at("rr_delta", 0.99f);
    expected.render.rr_delta = 10;
    check("rr_delta");
    click_at("alpha", 0.01f);
    expected.reconstruction.alpha = 0.001f;
    check("alpha");
    choose("norm", "mixed");
    expected.reconstruction.norm = Norm::mixed;
    check("norm");
    choose("norm", "l1");
    expected.reconstruction.norm = Norm::l1;
    check("norm");
    choose("norm", "none");
    expected.reconstruction.norm = Norm::none;
    check("norm");
}

TEST_F(PanelTest, ExpertSettingsAreCollapsed) {
    state().layout.open_sections = Layout().open_sections;
    frames(2);
    EXPECT_FALSE(has("roulette_depth"));
    click("more");
    click_at("roulette_depth", 0.99f);
    EXPECT_EQ(render(0).roulette_depth, most_edges);
    choose("filter_textures", "path");
    EXPECT_EQ(render(1).filter_textures, TextureFilter::path);
    click("more");
    EXPECT_FALSE(has("roulette_depth"));
}

TEST_F(PanelTest, LogSlidersReachSmallValuesInTheMiddle) {
    click_at("alpha", 0.5f);
    EXPECT_GT(pane(0).settings.reconstruction.alpha, 0.03f);
    EXPECT_LT(pane(0).settings.reconstruction.alpha, 0.3f);
    choose("roulette", "absolute");
    click_at("rr_delta", 0.5f);
    EXPECT_GT(render(0).rr_delta, 0.01f);
    EXPECT_LT(render(0).rr_delta, 1.0f);
}

TEST_F(PanelTest, ValuesOutsideASlidersRangeStayUntilItMoves) {
    choose("roulette", "absolute");
    state().panes[0].settings.render.rr_delta = state().panes[1].settings.render.rr_delta = 200;
    frames(3);
    ASSERT_TRUE(has("rr_delta"));
    EXPECT_EQ(render(0).rr_delta, 200);
    EXPECT_EQ(render(1).rr_delta, 200);
    click_at("rr_delta", 0.9f);
    EXPECT_LT(render(1).rr_delta, 200);
}

TEST_F(PanelTest, OnlySettingsWithAnEffectAreShown) {
    EXPECT_FALSE(has("rr_delta"));
    EXPECT_FALSE(has("pattern"));
    choose("pane0.method", "pr"); // linked: settings with an effect in any pane
    EXPECT_TRUE(has("pattern"));
    choose("pattern", "rooks");
    EXPECT_EQ(render(0).pattern, Pattern::rooks);
    choose("roulette", "absolute");
    EXPECT_TRUE(has("rr_delta"));
    click_at("linked", 0.5f);
    choose("pane0.method", "pt");
    click("pane0.picture");
    EXPECT_FALSE(has("tile"));
    click("pane1.picture");
    EXPECT_TRUE(has("tile"));
}

TEST_F(PanelTest, UnlinkedPanesHaveSeparateSettings) {
    choose("pane0.method", "pr");
    click_at("linked", 0.5f);
    EXPECT_FALSE(state().linked);
    click("pane0.picture");
    EXPECT_EQ(state().active_pane, 0);
    click_at("tile", 0.99f);
    EXPECT_EQ(render(0).tile, 16);
    EXPECT_EQ(render(1).tile, 6);
    click("pane1.picture");
    click_at("tile", 0.01f);
    EXPECT_EQ(render(0).tile, 16);
    EXPECT_EQ(render(1).tile, 1);
    click_at("linked", 0.5f); // linked again: all panes get the active pane's settings
    EXPECT_EQ(render(0).tile, 1);
    EXPECT_EQ(render(0).method, Method::pr);
}

TEST_F(PanelTest, DisplayAndSize) {
    click_at("exposure", 0.99f);
    EXPECT_NEAR(state().display.tone.exposure, 10, 0.3f);
    click_at("scale", 0.01f);
    EXPECT_NEAR(state().rendering.size.scale, 0.05f, 1e-3f);
    choose("size", "scene");
    EXPECT_EQ(state().rendering.size.base, SizeChoice::Base::scene);
    EXPECT_FALSE(has("width"));
    choose("size", "custom");
    EXPECT_TRUE(has("width"));
    choose("size", "pane");
    EXPECT_EQ(state().rendering.size.base, SizeChoice::Base::pane);
}

TEST_F(PanelTest, Buttons) {
    click("pause");
    EXPECT_FALSE(state().rendering.paused);
    EXPECT_FALSE(session.paused());
    click("pause");
    EXPECT_TRUE(session.paused());

    const std::uint64_t before = pane(0).generation;
    click("restart");
    EXPECT_GT(pane(0).generation, before);
    EXPECT_GT(pane(1).generation, before);

    state().camera.orbit({50, 0}, 100);
    frame();
    click("reset_camera");
    EXPECT_TRUE(state().camera.camera() == state().scene->camera());
}

TEST_F(PanelTest, MenusRunActions) {
    click("menu Buffer");
    click("menu Buffer/Gradient dx");
    EXPECT_EQ(pane(0).settings.buffer, Buffer::dx);
    EXPECT_EQ(pane(1).settings.buffer, Buffer::dx);
    click("menu Help");
    click("menu Help/Keys and mouse");
    EXPECT_TRUE(state().layout.show_help);
    frames(2);
    save("help.png");
    click("close_help");
    EXPECT_FALSE(state().layout.show_help);
}

TEST_F(PanelTest, TooltipAppearsAfterADelay) {
    move_to(place("tile").center());
    EXPECT_TRUE(viewer.controls().tooltip_pending());
    EXPECT_LE(viewer.next_frame_in(), 0.1);
    const auto before = screen();
    for (int i = 0; i < 40; ++i)
        frame();
    EXPECT_FALSE(viewer.controls().tooltip_pending());
    EXPECT_NE(before.rgb, screen().rgb);
    save("tooltip.png");
}

TEST_F(PanelTest, MouseMovesTheCamera) {
    const glm::vec2 middle = place("pane0.picture").center();
    const Camera home = state().camera.camera();
    drag(middle, {60, 20});
    EXPECT_FALSE(state().camera.camera() == home);
    EXPECT_EQ(state().active_pane, 0);
    state().camera.go_home();

    drag(middle, {60, 20}, 2); // middle button
    EXPECT_EQ(state().camera.forward(), glm::normalize(glm::vec3(home.to_world[2])));
    EXPECT_FALSE(state().camera.camera() == home);
    state().camera.go_home();

    move_to(middle);
    wheel(2);
    EXPECT_FALSE(state().camera.camera() == home);
    state().camera.go_home();

    modifiers(true, false);
    wheel(3);
    modifiers(false, false);
    EXPECT_TRUE(state().camera.camera() == home);
    EXPECT_GT(state().display.view.zoom(), 1.5f);
}

TEST_F(PanelTest, MouseOverThePanelDoesNotMoveTheCamera) {
    const Camera home = state().camera.camera();
    move_to(place("tile").center());
    wheel(3);
    drag(place("tile").center(), {10, 0});
    EXPECT_TRUE(state().camera.camera() == home);
}

TEST_F(PanelTest, KeysFlyAndRunActions) {
    const Camera home = state().camera.camera();
    viewer.keyboard().press(Key::w, Key::w, false, false);
    frames(3);
    EXPECT_EQ(viewer.next_frame_in(), 0);
    viewer.keyboard().release(Key::w);
    frames(2);
    EXPECT_TRUE(wait_until([&] { return viewer.next_frame_in() > 1; })); // after the picture of the new camera
    EXPECT_FALSE(state().camera.camera() == home);
    type(Key::home);
    EXPECT_TRUE(state().camera.camera() == home);
    type(Key::digit4);
    EXPECT_EQ(pane(1).settings.buffer, Buffer::dy);
    type(Key::q, true);
    EXPECT_TRUE(state().wishes.quit);
}

} // namespace
} // namespace tessera::test
