// Path inspector and slow motion in settings files.

#include "render/inspect/inspection.h"
#include "render/io/text.h"
#include "tests/ui/viewer_harness.h"
#include "ui/settings/settings_file.h"

#include <memory>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

struct InspectionSettings : testing::Test {
    InspectionSettings() { h->rest(3); }

    ViewerState& state() { return h->state(); }
    SampleChoice sample(int index, glm::ivec2 pixel) { return {h->pane(index).slot, pixel, {}}; }

    /// Waits until the inspector shows paths and surroundings.
    bool wait_for_paths() {
        const bool found =
            h->wait_until([&] { return state().inspector.inspection && state().space.surroundings; });
        h->frames(3);
        return found;
    }
    /// Waits until the slow motion shows its tile.
    bool wait_for_tile() {
        const SlowMotion& slow = state().slow_motion;
        return h->wait_until([&] { return slow.shows_choice() && !slow.frames; });
    }
    /// Replaces the viewer by another one with its settings. Returns the settings.
    std::string begin_anew() {
        const std::string text = settings_json(state());
        h.reset(); // only one viewer may exist
        h = std::make_unique<ViewerHarness>();
        h->rest(3);
        apply_settings_json(state(), text, "settings.json");
        return text;
    }

    std::unique_ptr<ViewerHarness> h = std::make_unique<ViewerHarness>();
};

TEST_F(InspectionSettings, TheInspectorShowsTheSamePixel) {
    state().set_pane_count(1); // its slot is not the first
    h->type(Key::i);
    state().inspector.choose(sample(0, {16, 14}));
    state().inspector.direction = Inspector::Direction::from_pixel;
    state().inspector.follows = true;
    ASSERT_TRUE(wait_for_paths());
    h->drag(h->place("space").center(), {50, 20});
    const glm::vec3 forward = state().space.camera.forward();
    h->save("inspector-before.png");
    begin_anew();
    EXPECT_TRUE(state().inspector.active);
    EXPECT_TRUE(state().inspector.follows);
    EXPECT_EQ(state().inspector.direction, Inspector::Direction::from_pixel);
    ASSERT_TRUE(wait_for_paths());
    EXPECT_EQ(state().inspector.inspection->pixel, glm::ivec2(16, 14));
    EXPECT_EQ(state().inspector.inspection->method, Method::gpr);
    EXPECT_FALSE(state().space.fits); // the view is restored
    EXPECT_LT(glm::distance(state().space.camera.forward(), forward), 1e-5f);
    h->save("inspector-restored.png");
}

TEST_F(InspectionSettings, AGivenPassIsTheSame) {
    state().inspect({16, 14}, 1, 0);
    ASSERT_TRUE(wait_for_paths());
    begin_anew();
    ASSERT_TRUE(wait_for_paths());
    EXPECT_EQ(state().inspector.inspection->pixel, glm::ivec2(16, 14));
    EXPECT_EQ(state().inspector.inspection->pass, 1); // of 3 passes
}

TEST_F(InspectionSettings, TheViewInSpaceBelongsToItsScene) {
    h->type(Key::i);
    state().inspector.choose(sample(1, {16, 14}));
    ASSERT_TRUE(wait_for_paths());
    const glm::vec3 at_first = state().space.camera.forward();
    h->drag(h->place("space").center(), {50, 20});
    h->viewer.load("another", [](SceneNotes&, LoadProgress&) { return viewer_scene(); });
    h->wait_until([&] { return state().scene_info.shown == 2 && h->viewer.settled(3); });
    h->wait_until([&] { return state().inspector.generation == h->pane(1).generation; });
    ASSERT_TRUE(wait_for_paths());
    EXPECT_LT(glm::distance(state().space.camera.forward(), at_first), 1e-5f);
}

TEST_F(InspectionSettings, TheSlowMotionShowsTheSameTile) {
    const ImageView before(1.5f, {0.4f, 0.5f});
    state().set_view(before);
    h->type(Key::j);
    state().slow_motion.held = true;
    state().slow_motion.speed = 7.5f;
    state().slow_motion.start(sample(1, {40, 6}));
    ASSERT_TRUE(wait_for_tile());
    const ImageView enlarged = state().display.view;
    ASSERT_GT(enlarged.zoom(), 2);
    const std::string text = begin_anew();
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(wait_for_tile());
        EXPECT_TRUE(state().slow_motion.active);
        EXPECT_TRUE(state().slow_motion.held);
        EXPECT_EQ(state().slow_motion.speed, 7.5f);
        EXPECT_TRUE(state().slow_motion.tile->tile.contains({40, 6}));
        EXPECT_TRUE(state().display.view == enlarged);
        apply_settings_json(state(), text, "settings.json"); // again, while the slow motion is on
    }
    h->type(Key::j);
    h->frames(2);
    EXPECT_TRUE(state().display.view == before);
}

TEST_F(InspectionSettings, ASampleOfAnOlderRenderIsNotSaved) {
    const Snapshot& s = *h->pane(1).snapshot;
    const auto origin = std::make_shared<const PassOrigin>(
        PassOrigin{state().scene, s.camera, {48, 36}, s.settings, s.learned, s.generation});
    state().set_inspector(true);
    state().inspector.choose({h->pane(1).slot, {3, 4}, 1, origin});
    EXPECT_NE(settings_json(state()).find("\"sample\""), std::string::npos);
    state().panes[1].settings.render.max_depth = 2;
    h->frames(3);
    EXPECT_EQ(settings_json(state()).find("\"sample\""), std::string::npos);
}

TEST_F(InspectionSettings, MissingFieldsChangeNothing) {
    h->type(Key::i);
    state().inspector.choose(sample(1, {16, 14}));
    apply_settings_json(state(), "{\"panes\": [{}, {}]}", "old.json");
    EXPECT_TRUE(state().inspector.active);
    EXPECT_TRUE(state().inspector.sample == sample(1, {16, 14}));
    EXPECT_EQ(settings_json(state()).find("\"space\""),
              std::string::npos); // the view in space has no direction yet
}

TEST_F(InspectionSettings, ErrorsHaveAPosition) {
    const std::string before = settings_json(state());
    const std::pair<const char*, const char*> cases[] = {
        {"\"inspector\": true", "this must be an object"},
        {"\"inspector\": {\"on\": 1}", "on has the wrong type: number"},
        {"\"inspector\": {\"shows\": \"both\"}", "shows is \"both\": must be one of to_pixel, from_pixel"},
        {"\"inspector\": {\"sample\": {\"pane\": 2}}", "pane is out of range"},
        {"\"inspector\": {\"sample\": {\"pane\": 1, \"x\": -1}}", "x is out of range"},
        {"\"inspector\": {\"sample\": {\"pane\": 1, \"pass\": -1}}", "pass is out of range"},
        {"\"slow_motion\": {\"speed\": 0}", "speed is out of range"},
        {"\"space\": {\"fov\": 40}", "the camera has no 'to_world'"},
    };
    for (const auto& [field, expected] : cases) {
        try {
            apply_settings_json(state(), std::string("{\"panes\": [{}],\n ") + field + "}", "bad.json");
            ADD_FAILURE() << field;
        } catch (const LoadError& error) {
            const std::string text = error.what();
            EXPECT_EQ(text.find("bad.json:2:"), 0u) << text;
            EXPECT_NE(text.find(expected), std::string::npos) << text;
        }
        EXPECT_EQ(settings_json(state()), before) << field;
    }
    apply_settings_json(state(), "{\"panes\": [{}],\n \"inspector\": {\"sample\": {\"z\": 1}}}", "odd.json");
    EXPECT_EQ(state().messages.back().text, "odd.json:2:32: the unknown field \"z\" is ignored");
}

} // namespace
} // namespace tessera::test
