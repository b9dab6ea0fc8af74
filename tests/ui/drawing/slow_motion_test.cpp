// The slow motion shows the base paths of one tile in turn, over the active pane's picture.

#include "render/inspect/inspection.h"
#include "tests/ui/viewer_harness.h"
#include "ui/inside/drawing.h"
#include "ui/inside/inside.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct SlowMotionView : testing::Test, ViewerHarness {
    SlowMotionView() { rest(3); }

    SlowMotion& slow() { return state().slow_motion; }
    void open(bool held = true) {
        type(Key::j);
        slow().held = held;
        ASSERT_TRUE(wait_until([&] { return slow().shows_choice(); }));
        frames(3);
    }
    void character(char c) {
        viewer.keyboard().type(c);
        frames(2);
    }
    glm::vec2 middle(glm::ivec2 pixel) {
        const Placement placement = state().display.view.place({48, 36}, pane(slow().slot).canvas_size);
        const ControlRect rect = place("pane" + std::to_string(slow().slot) + ".picture");
        return rect.min + placement.origin + (glm::vec2(pixel) + 0.5f) / glm::vec2(48, 36) * placement.extent;
    }
    glm::vec3 colour(const ScreenPixels& pixels, glm::vec2 at) const {
        const std::uint8_t* p = pixels.at(static_cast<int>(at.x), static_cast<int>(at.y));
        return {p[0], p[1], p[2]};
    }
};

TEST_F(SlowMotionView, ShowsATileOfTheActivePaneLarge) {
    const ImageView before = state().display.view;
    const ScreenPixels untouched = screen();
    open();
    EXPECT_TRUE(has("slow.step"));
    EXPECT_EQ(slow().slot, state().active().slot);
    EXPECT_EQ(slow().tile->pass, 2);
    EXPECT_TRUE(slow().tile->tile.contains({24, 18}));
    EXPECT_GT(state().display.view.zoom(), 2);
    const ControlRect picture = place("pane1.picture");
    for (const InspectedSet& set : slow().tile->sets)
        for (const glm::ivec2 p : set.pixels) { // all pixels are visible
            EXPECT_GT(middle(p).x, picture.min.x);
            EXPECT_LT(middle(p).x, picture.max.x);
            EXPECT_LT(middle(p).y, picture.max.y);
        }
    save("slow-motion.png");
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    type(Key::j);
    frames(2);
    EXPECT_FALSE(has("slow.step"));
    EXPECT_TRUE(state().display.view == before);
    EXPECT_EQ(screen().rgb, untouched.rgb);
}

TEST_F(SlowMotionView, StepsFillThePixels) {
    state().panes[1].settings.render.roulette = RouletteKind::none;
    wait_until([&] { return viewer.settled(3); });
    open();
    EXPECT_EQ(slow().current, 0);
    character('>'); // shows the first base path
    EXPECT_EQ(slow().current, 0);
    EXPECT_EQ(slow().arrived, 1);
    const ScreenPixels first = screen();
    int steps = 0;
    while (slow().place().base + 1 < slow().set().size()) {
        character('>');
        ++steps;
    }
    EXPECT_EQ(slow().current, steps);
    const InspectedSet& set = slow().set();
    save("slow-motion-last.png");
    // The set's first pixel shows its accumulated colour beside the numbers and arrows.
    const Rgb expected = 255.0f * displayed(set.radiance(0, set.size()), state().display.tone);
    const float unit = middle({1, 0}).x - middle({0, 0}).x;
    const glm::vec3 seen = colour(screen(), middle(set.pixels[0]) + glm::vec2(-0.38f, -0.02f) * unit);
    const glm::vec3 before = colour(first, middle(set.pixels[0]) + glm::vec2(-0.38f, -0.02f) * unit);
    EXPECT_LT(glm::distance(seen, expected), 12);
    EXPECT_GT(glm::length(seen), glm::length(before));
    character('<');
    EXPECT_EQ(slow().current, steps - 1);
    click("slow.step");
    EXPECT_EQ(slow().current, steps);
    click("slow.back");
    EXPECT_EQ(slow().current, steps - 1);
}

TEST_F(SlowMotionView, DrawsArrowsInTheColoursOfTheOutcomes) {
    state().panes[1].settings.render.roulette = RouletteKind::none;
    wait_until([&] { return viewer.settled(3); });
    open();
    character('>');
    const InspectedSet& set = slow().set();
    int looked = 0;
    for (int m = 1; m < set.size(); ++m) {
        const InspectedShift& s = set.shift(0, m);
        if (!s.is_tried)
            continue;
        // The mark lies inside the pixel.
        const float unit = middle({1, 0}).x - middle({0, 0}).x;
        const glm::vec3 wanted(outcome_colour(s) & 255, outcome_colour(s) >> 8 & 255,
                               outcome_colour(s) >> 16 & 255);
        float nearest = 1e9f;
        const ScreenPixels pixels = screen();
        for (float in = 0.3f; in < 0.5f; in += 0.5f / unit)
            nearest = std::min(nearest,
                               glm::distance(colour(pixels, middle(s.to) + glm::vec2(-in, 0.2f) * unit), wanted));
        EXPECT_LT(nearest, 110) << m;
        ++looked;
    }
    EXPECT_GT(looked, 0);
}

TEST_F(SlowMotionView, AutomaticExposureFitsTheTile) {
    open();
    slow().step(slow().tile->base_count()); // all base paths are shown
    frames(2);
    const auto tile_brightness = [&] { // of the pixels' upper left corners, which have no arrows or numbers
        const ScreenPixels pixels = screen();
        const float unit = middle({1, 0}).x - middle({0, 0}).x;
        double sum = 0;
        for (const InspectedSet& set : slow().tile->sets)
            for (const glm::ivec2 p : set.pixels)
                sum += static_cast<double>(colour(pixels, middle(p) - 0.3f * unit).g);
        return sum;
    };
    state().display.tone.exposure = -9;
    frames(2);
    const double dark = tile_brightness();
    type(Key::f6);
    frames(2);
    const float found = state().display.tone.exposure;
    EXPECT_GT(tile_brightness(), 2 * dark + 100);
    EXPECT_GT(found, -9);
    save("slow-motion-exposed.png");
    state().display.tone.exposure = 9;
    frames(2);
    type(Key::f6);
    EXPECT_FLOAT_EQ(state().display.tone.exposure, found);
    type(Key::j); // the picture is shown again
    frames(2);
    type(Key::f6);
    frames(2);
    EXPECT_NE(state().display.tone.exposure, found);
}

TEST_F(SlowMotionView, PlaysPausesAndContinuesWithTheNextTile) {
    open(false);
    slow().speed = 20;
    ASSERT_TRUE(wait_until([&] { return slow().current > 2; }));
    EXPECT_EQ(viewer.next_frame_in(), 0);
    type(Key::space, false, true);
    EXPECT_TRUE(slow().held);
    EXPECT_GT(viewer.next_frame_in(), 1e6); // nothing moves, so no frame is due
    const int held_at = slow().current;
    frames(10);
    EXPECT_EQ(slow().current, held_at);
    click("slow.hold");
    EXPECT_FALSE(slow().held);
    slow().speed = 60;
    const auto tile = slow().tile;
    ASSERT_TRUE(wait_until([&] { return slow().tile != tile; }));
    EXPECT_EQ(slow().tile->tile.x0, tile->tile.x1);
    type(Key::j, false, true);
    ASSERT_TRUE(wait_until([&] { return slow().shows_choice() && slow().tile->tile.x0 > tile->tile.x1; }));
}

TEST_F(SlowMotionView, AClickChoosesTheTileInTheActivePane) {
    open();
    const auto camera = state().camera.camera();
    const auto tile = slow().tile;
    const glm::ivec2 other(tile->tile.x1 + 1, tile->tile.y0);
    click(middle(other));
    ASSERT_TRUE(wait_until([&] { return slow().tile->tile.contains(other); }));
    EXPECT_TRUE(state().camera.camera() == camera);
    type(Key::tab);
    ASSERT_TRUE(wait_until([&] { return slow().slot == 0 && slow().shows_choice(); }));
    EXPECT_EQ(slow().tile->settings.method, Method::pt);
    EXPECT_EQ(slow().tile->base_count(), 1);
    frames(3);
    save("slow-motion-pt.png");
    type(Key::i); // the inspector replaces the slow motion
    EXPECT_FALSE(slow().active);
    EXPECT_TRUE(has("inspector.direction"));
    EXPECT_FALSE(has("slow.step"));
}

// The picture moves to the chosen tile, so another pixel lies under the mouse.
TEST_F(SlowMotionView, AHeldButtonChoosesNoOtherTile) {
    open();
    type(Key::f); // fits the picture
    const glm::ivec2 chosen(40, 6);
    move_to(middle(chosen));
    press();
    ASSERT_TRUE(wait_until([&] { return slow().tile->tile.contains(chosen); }));
    for (int i = 0; i < 40; ++i) {
        frame(0.1f);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_GT(state().display.view.zoom(), 2);
    EXPECT_EQ(slow().sample->pixel, chosen);
    EXPECT_TRUE(slow().tile->tile.contains(chosen));
    release();
    EXPECT_EQ(slow().sample->pixel, chosen);
}

TEST_F(SlowMotionView, ContinuesInASmallerPicture) {
    open(false);
    slow().start({1, {47, 35}, {}});
    ASSERT_TRUE(wait_until([&] { return slow().shows_choice(); }));
    state().rendering.size.custom = {24, 18};
    ASSERT_TRUE(wait_until([&] {
        return state().request_size() == glm::ivec2(24, 18) && slow().generation == pane(1).generation &&
               slow().shows_choice();
    }));
    EXPECT_EQ(slow().sample->pixel, glm::ivec2(23, 17));
    EXPECT_TRUE(slow().is_playing());
}

TEST_F(SlowMotionView, KeepsAViewThatTheUserHasSetMeanwhile) {
    state().display.view = ImageView(2, {0.3f, 0.3f});
    open();
    type(Key::f);
    EXPECT_TRUE(state().display.view == ImageView());
    type(Key::j);
    EXPECT_TRUE(state().display.view == ImageView());

    state().display.view = ImageView(2, {0.3f, 0.3f});
    open();
    viewer.load("another", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    ASSERT_TRUE(wait_until([&] { return state().scene_info.shown == 2; }));
    type(Key::j);
    EXPECT_TRUE(state().display.view == ImageView());
}

TEST_F(SlowMotionView, StaysWithItsPane) {
    open();
    const auto tile = slow().tile;
    type(Key::digit1, true); // the second pane becomes the first
    frames(10);
    EXPECT_EQ(slow().tile, tile);
    EXPECT_TRUE(shows_slow_motion(0, state()));
}

TEST_F(SlowMotionView, SurvivesChangesOfAllKinds) {
    open(false);
    slow().speed = 60;
    for (const Method method : {Method::pr, Method::gpt, Method::gpr}) {
        state().panes[1].settings.render.method = method;
        state().panes[1].settings.render.pattern = method == Method::pr ? Pattern::rooks : Pattern::tile;
        ASSERT_TRUE(wait_until([&] { return slow().tile && slow().tile->settings.method == method; }));
        frames(30);
        save("slow-motion-" + std::string(short_name(method)) + ".png");
    }
    state().camera.orbit({20, 5}, 300);
    frames(30);
    resize({90, 60});
    frames(10);
    resize({1, 1});
    frames(3);
    resize({1280, 720});
    state().layout.theme = Theme::light;
    state().layout.text_factor = 2.0f;
    frames(30);
    save("slow-motion-200.png");
    type(Key::digit1, true);
    frames(10);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(SlowMotionBeforeAnyScene, IsHarmless) {
    ViewerHarness h;
    h.type(Key::j);
    h.type(Key::j, false, true);
    h.viewer.keyboard().type('>');
    h.viewer.keyboard().type('<');
    h.frames(5);
    EXPECT_TRUE(h.state().slow_motion.active);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

} // namespace
} // namespace tessera::test
