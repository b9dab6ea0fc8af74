// Panes: number, comparison, and limits of rendering.

#include "tests/ui/drawing/panes_fixture.h"
#include "ui/gl/gui.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera::test {
namespace {

TEST_F(Panes, MenuAndKeysSetTheNumberOfPanes) {
    click("menu Panes");
    click("menu Panes/Four panes");
    ASSERT_EQ(state().panes.size(), 4u);
    wait_for_settled();
    EXPECT_EQ(pane(0).settings.render.method, Method::pt);
    EXPECT_EQ(pane(1).settings.render.method, Method::pr); // the methods that no pane has
    EXPECT_EQ(pane(2).settings.render.method, Method::gpt);
    EXPECT_EQ(pane(3).settings.render.method, Method::gpr);
    EXPECT_GT(place("pane2.picture").min.y, place("pane0.picture").max.y);
    for (int i = 0; i < 4; ++i)
        EXPECT_GT(brightness("pane" + std::to_string(i) + ".picture"), 10) << i;
    save("four-panes.png");

    choose("pane2.method", "pt");
    type(Key::digit2, true);
    EXPECT_EQ(state().panes.size(), 2u);
    frames(3);
    EXPECT_FALSE(has("pane2.picture"));
    EXPECT_EQ(session.latest(3), nullptr);
    type(Key::g);
    ASSERT_EQ(state().panes.size(), 4u);
    EXPECT_EQ(pane(2).settings.render.method, Method::pt); // restored
    EXPECT_EQ(pane(3).settings.render.method, Method::pr);
    type(Key::g);
    EXPECT_EQ(state().panes.size(), 1u);
    wait_for_settled();
    EXPECT_TRUE(has("pane0.picture"));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// Input over the last pane takes effect in the first pane in the same frame, although that is drawn earlier.
TEST_F(Panes, MoveTogetherWithinOneFrame) {
    const auto first_pane = [&] {
        const ScreenPixels pixels = screen();
        const ControlRect rect = place("pane0.picture");
        std::vector<std::uint8_t> inside;
        for (int y = static_cast<int>(rect.min.y) + 1; y < static_cast<int>(rect.max.y) - 1; ++y)
            for (int x = static_cast<int>(rect.min.x) + 1; x < static_cast<int>(rect.max.x) - 1; ++x)
                inside.push_back(pixels.at(x, y)[0]);
        return inside;
    };
    move_to(place("pane1.picture").center());
    modifiers(true, false);
    frames(3);
    const auto before = first_pane();
    send_mouse_wheel(4);
    frame();
    const auto at_once = first_pane();
    frame();
    EXPECT_NE(at_once, before);
    EXPECT_EQ(at_once, first_pane());
    modifiers(false, false);
}

TEST_F(Panes, TheActivePaneStaysWhenOthersClose) {
    click("pane1.picture");
    type(Key::digit1, true);
    EXPECT_EQ(state().active_pane, 0);
    EXPECT_EQ(pane(0).settings.render.method, Method::gpr);
    type(Key::digit2, true);
    EXPECT_EQ(pane(1).settings.render.method, Method::pt);
}

// A pane keeps its samples when its position changes.
TEST_F(Panes, TheActivePaneKeepsItsSamples) {
    type(Key::digit4, true);
    wait_for_settled();
    click("pane3.picture");
    const PaneState before = pane(3);
    type(Key::digit1, true);
    frames(3);
    EXPECT_EQ(pane(0).generation, before.generation);
    EXPECT_EQ(pane(0).snapshot->generation, before.generation);
    EXPECT_EQ(pane(0).snapshot->spp, 3);
    EXPECT_EQ(session.latest(0), nullptr); // the slot of a closed pane
    EXPECT_NE(session.latest(before.slot), nullptr);
    state().rendering.pace.spp_limit = 5; // the render continues
    EXPECT_TRUE(wait_until([&] { return pane(0).snapshot->spp == 5; }));
    EXPECT_EQ(pane(0).snapshot->generation, before.generation);
}

// Panes with equal requests do not differ from the last requests of their slots.
TEST_F(Panes, PanesWithEqualSettingsGetTheirOwnPictures) {
    type(Key::digit4, true);
    for (PaneState& p : state().panes)
        p.settings.render.method = Method::gpr;
    wait_for_settled();
    click("pane3.picture");
    type(Key::digit2, true);
    ASSERT_EQ(state().active_pane, 1);
    wait_for_settled();        // does not stay at "starting"
    state().set_pane_count(1); // closed and reopened within one frame
    state().set_pane_count(2);
    wait_for_settled();
    EXPECT_NE(pane(0).slot, pane(1).slot);
}

TEST_F(Panes, AloneTheActivePaneFillsTheArea) {
    const float before = place("pane1.picture").max.x - place("pane1.picture").min.x;
    type(Key::o);
    EXPECT_FALSE(has("pane0.picture"));
    EXPECT_GT(place("pane1.picture").max.x - place("pane1.picture").min.x, before * 1.8f);
    type(Key::tab);
    EXPECT_TRUE(has("pane0.picture"));
    EXPECT_FALSE(has("pane1.picture"));
    type(Key::o);
    EXPECT_TRUE(has("pane1.picture"));
}

TEST_F(Panes, WipeShowsBothPicturesAndItsLineCanBeDragged) {
    click("pane0.picture");
    ASSERT_EQ(state().active_pane, 0);
    const ScreenPixels apart = screen();
    EXPECT_GT(distance(0, 1, 0.7f, apart), 5); // the pictures differ
    type(Key::v);
    EXPECT_EQ(pane(0).settings.comparison.kind, Comparison::Kind::wipe);
    const ScreenPixels wiped = screen();
    save("wipe.png");
    EXPECT_LT(distance(0, 1, 0.7f, wiped), 1); // the other pane's picture on the right
    EXPECT_GT(distance(0, 1, 0.3f, wiped), 5);

    // The line can be grabbed 12 units beside it.
    const auto camera = state().camera.position();
    const ControlRect rect = place("pane0.picture");
    const float width = rect.max.x - rect.min.x;
    drag(point(0, 0.5f, 0.6f) + glm::vec2(12, 0), {width * 0.3f, 5});
    EXPECT_NEAR(state().layout.wipe, 0.8f, 0.02f);
    EXPECT_EQ(state().camera.position(), camera);
    EXPECT_GT(distance(0, 1, 0.7f, screen()), 5);
    drag(point(0, 0.8f, 0.6f), {-2 * width, 0});
    EXPECT_EQ(state().layout.wipe, 0);
    drag(point(0, 0.4f, 0.6f), {20, 0}); // elsewhere, a drag moves the camera
    EXPECT_NE(state().camera.position(), camera);
    type(Key::v);
    EXPECT_EQ(pane(0).settings.comparison.kind, Comparison::Kind::off);
}

TEST_F(Panes, MotionBeforeThePressMovesNoCamera) {
    move_to(point(1, 0.1f, 0.3f));
    const glm::vec3 before = state().camera.position();
    const glm::vec2 to = point(1, 0.6f, 0.6f);
    send_mouse_position({to.x, to.y}); // in the same, slow frame
    press();
    release();
    EXPECT_EQ(state().camera.position(), before);
    drag(to, {30, 0});
    EXPECT_NE(state().camera.position(), before);
}

TEST_F(Panes, FlickerShowsTheOtherPictureWhileItsKeyIsHeld) {
    click("pane0.picture");
    const ScreenPixels before = screen();
    viewer.keyboard().press(Key::b, Key::b, false, false);
    frames(2);
    EXPECT_LT(distance(0, 1, 0.3f, screen()), 1);
    EXPECT_LT(distance(0, 1, 0.7f, screen()), 1);
    save("flicker.png");
    viewer.keyboard().release(Key::b);
    frames(2);
    EXPECT_EQ(screen().rgb, before.rgb);
}

TEST_F(Panes, DifferenceHasTheSignOfTheDifference) {
    click("pane0.picture");
    type(Key::n);
    state().display.tone.exposure = 3;
    frames(2);
    save("difference.png");
    const ScreenPixels pixels = screen();
    const RgbImage& a = viewer.pictures().image(0).pixels();
    const RgbImage& b = viewer.pictures().image(1).pixels();
    const Placement placement = state().display.view.place(state().request_size(), pane(0).canvas_size);
    int compared = 0;
    for (int y = 5; y < a.height(); y += 3) {
        for (int x = 1; x < a.width(); x += 3) {
            const float difference = luminance(a(x, y) - b(x, y));
            if (std::abs(difference) < 0.01f)
                continue;
            const glm::vec2 share = (glm::vec2(x, y) + 0.5f) / glm::vec2(a.width(), a.height());
            const glm::vec3 seen =
                colour(pixels, place("pane0.picture").min + placement.origin + share * placement.extent);
            EXPECT_EQ(seen.r > seen.b, difference > 0) << x << ',' << y << ' ' << difference;
            ++compared;
        }
    }
    EXPECT_GT(compared, 50);
    choose("compare", "off");
    EXPECT_EQ(pane(0).settings.comparison.kind, Comparison::Kind::off);
}

TEST_F(Panes, AnyTwoPanesCanBeCompared) {
    type(Key::digit4, true);
    wait_for_settled();
    click("pane1.picture");
    choose("compare", "wipe");
    choose("compare_with", "4");
    EXPECT_EQ(state().compared_with(1), 3);
    const ScreenPixels pixels = screen();
    EXPECT_LT(distance(1, 3, 0.7f, pixels), 1);
    type(Key::digit2, true); // the compared pane is closed
    EXPECT_EQ(state().compared_with(1), 0);
}

TEST_F(Panes, ComparedBuffersMayDiffer) {
    click("pane0.picture");
    choose("pane1.buffer", "outcomes");
    type(Key::v);
    EXPECT_LT(distance(0, 1, 0.7f, screen()), 1);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    save("wipe-buffers.png");
}

TEST_F(Panes, StepsOnePass) {
    type(Key::space);
    viewer.keyboard().type('.');
    ASSERT_TRUE(wait_until([&] { return pane(0).snapshot->spp == 4 && pane(1).snapshot->spp == 4; }));
    click("step");
    ASSERT_TRUE(wait_until([&] { return pane(0).snapshot->spp == 5 && pane(1).snapshot->spp == 5; }));
    EXPECT_TRUE(state().rendering.paused);
}

TEST_F(Panes, StopsAtSecondsAndLimitsRestartNothing) {
    const std::uint64_t generation = pane(0).generation;
    state().rendering.pace = {Pace::Equal::time, 0, pane(0).snapshot->seconds + 0.15};
    ASSERT_TRUE(wait_until([&] { return pane(0).snapshot->seconds >= state().rendering.pace.seconds_limit; }));
    EXPECT_EQ(pane(0).generation, generation);
    EXPECT_GT(pane(0).snapshot->spp, 3);
    choose("equal", "spp");
    EXPECT_EQ(state().rendering.pace.equal, Pace::Equal::spp);
}

} // namespace
} // namespace tessera::test
