#include "ui/panels/found_actions.h"
#include "ui/state/actions.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

ViewerState two_panes() {
    ViewerState state;
    state.panes.resize(2);
    state.panes[0].settings.render.method = Method::pt;
    state.panes[1].settings.render.method = Method::gpr;
    state.active_pane = 1;
    return state;
}

Shortcut key(Key k) {
    return {k, false, false, 0};
}
Shortcut character(char c) {
    return {Key::none, false, false, c};
}

void type(ViewerState& state, Shortcut shortcut, bool entering_text = false) {
    const Shortcut typed[] = {shortcut};
    run_shortcuts(typed, entering_text, state);
}

const Action& action(const std::string& name) {
    for (const Action& a : actions()) {
        if (a.name == name)
            return a;
    }
    throw std::runtime_error("no action " + name);
}

TEST(Actions, EachBufferHasAnAction) {
    for (const Buffer buffer : all_buffers) {
        ViewerState state = two_panes();
        action(std::string(long_name(buffer))).run(state);
        for (const PaneState& pane : state.panes)
            EXPECT_EQ(pane.settings.buffer, buffer) << long_name(buffer);
    }
}

TEST(Actions, EachHasANameHelpAndAUniqueShortcut) {
    std::set<std::string> shortcuts, names;
    for (const Action& a : actions()) {
        EXPECT_TRUE(names.insert(a.name).second) << a.name;
        EXPECT_GT(std::string(a.help).size(), 5u) << a.name;
        if (a.shortcut != Shortcut{}) {
            EXPECT_TRUE(shortcuts.insert(to_string(a.shortcut)).second) << a.name;
        }
        if (a.second_shortcut != Shortcut{}) {
            EXPECT_TRUE(shortcuts.insert(to_string(a.second_shortcut)).second) << a.name;
        }
    }
}

TEST(Actions, NoShortcutIsAFlyingKey) {
    for (const Action& a : actions()) {
        for (Key fly : {Key::w, Key::a, Key::s, Key::d, Key::q, Key::e, Key::left, Key::right, Key::up, Key::down})
            EXPECT_FALSE(a.shortcut == key(fly) || a.second_shortcut == key(fly)) << a.name;
    }
}

TEST(Actions, EscapeCancelsALoadUnlessItEndsTextEntry) {
    ViewerState state = two_panes();
    state.scene_info.loading = "a scene";
    type(state, key(Key::escape), true);
    EXPECT_FALSE(state.wishes.cancel_scene);
    type(state, key(Key::escape));
    EXPECT_TRUE(state.wishes.cancel_scene);
}

TEST(Actions, RareActionsAreInTheCommandPaletteOnly) {
    std::size_t in_menus = 0;
    for (const Action& a : actions()) {
        in_menus += is_in_menu(a) && std::string_view(a.menu) == "Buffer";
        const auto found = actions_with(a.name);
        EXPECT_NE(std::ranges::find(found, &a), found.end()) << a.name;
    }
    EXPECT_EQ(in_menus, 8u);
    for (const char* name : {"Error: squared", "Error: absolute", "Error: relative", "Depth", "Next base path"})
        EXPECT_FALSE(is_in_menu(action(name))) << name;
}

TEST(Actions, ActionsOfAMenuAreContiguous) {
    std::set<std::string> seen;
    std::string previous;
    for (const Action& a : actions()) {
        if (a.menu != previous) {
            EXPECT_TRUE(seen.insert(a.menu).second) << a.menu << " is not contiguous";
        }
        previous = a.menu;
    }
}

TEST(Actions, EveryShortcutRunsItsAction) {
    ViewerState state = two_panes();
    type(state, key(Key::space));
    EXPECT_TRUE(state.rendering.paused);
    type(state, key(Key::space));
    EXPECT_FALSE(state.rendering.paused);
    type(state, key(Key::r));
    EXPECT_TRUE(state.wishes.restart);
    type(state, {Key::q, true, false, 0});
    EXPECT_TRUE(state.wishes.quit);
    type(state, {Key::s, true, false, 0});
    EXPECT_EQ(state.layout.choosing, FilePurpose::save);
    state.layout.choosing.reset();
    type(state, {Key::f12, false, false, 0});
    EXPECT_TRUE(state.wishes.saves.has(SaveKind::window));
    type(state, {Key::i, true, false, 0});
    EXPECT_TRUE(state.layout.sample_form.show);
    type(state, key(Key::escape));
    EXPECT_FALSE(state.layout.sample_form.show);
    type(state, key(Key::f5));
    EXPECT_TRUE(state.wishes.reload);
    type(state, key(Key::k));
    EXPECT_TRUE(state.wishes.saves.has(SaveKind::camera));
    EXPECT_FALSE(state.wishes.copy_camera);
    type(state, {Key::k, false, true, 0});
    EXPECT_TRUE(state.wishes.copy_camera);
    type(state, key(Key::p));
    EXPECT_FALSE(state.layout.show_panel);
    type(state, key(Key::t));
    EXPECT_TRUE(state.layout.show_statistics);
    type(state, key(Key::f2));
    EXPECT_TRUE(state.layout.show_messages);
    type(state, key(Key::tab));
    EXPECT_EQ(state.active_pane, 0);
}

TEST(Actions, HelpOpensByBothKeysAndCloses) {
    ViewerState state = two_panes();
    type(state, key(Key::f1));
    EXPECT_TRUE(state.layout.show_help);
    type(state, key(Key::escape));
    EXPECT_FALSE(state.layout.show_help);
    type(state, character('?'));
    EXPECT_TRUE(state.layout.show_help);
    type(state, character('?'));
    EXPECT_FALSE(state.layout.show_help);
}

TEST(Actions, KeysSetTheMethodOfTheActivePane) {
    ViewerState state = two_panes();
    state.active_pane = 0;
    for (Method expected : {Method::pr, Method::gpt, Method::gpr, Method::pt}) {
        type(state, key(Key::m));
        EXPECT_EQ(state.panes[0].settings.render.method, expected);
        EXPECT_EQ(state.panes[1].settings.render.method, Method::gpr);
    }
    type(state, {Key::m, false, true, 0});
    EXPECT_EQ(state.panes[0].settings.render.method, Method::gpr);
}

TEST(Actions, SlowMotionAndInspectorCloseEachOther) {
    ViewerState state = two_panes();
    type(state, key(Key::j));
    EXPECT_TRUE(state.slow_motion.active);
    type(state, {Key::space, false, true, 0});
    EXPECT_TRUE(state.slow_motion.held);
    EXPECT_FALSE(state.rendering.paused);
    type(state, key(Key::i));
    EXPECT_TRUE(state.inspector.active);
    EXPECT_FALSE(state.slow_motion.active);
    type(state, key(Key::j));
    EXPECT_FALSE(state.inspector.active);
    EXPECT_FALSE(state.slow_motion.held);
    type(state, character('>')); // there is no tile yet
    EXPECT_TRUE(state.slow_motion.held);
}

TEST(Actions, BufferKeysApplyToAllPanes) {
    const std::pair<Key, Buffer> keys[] = {{Key::digit2, Buffer::primal},   {Key::digit3, Buffer::dx},
                                           {Key::digit4, Buffer::dy},       {Key::digit5, Buffer::reused},
                                           {Key::digit6, Buffer::outcomes}, {Key::digit1, Buffer::reconstruction}};
    ViewerState state = two_panes();
    for (const auto& [k, buffer] : keys) {
        type(state, key(k));
        for (const PaneState& pane : state.panes)
            EXPECT_EQ(pane.settings.buffer, buffer);
    }
    action("Roulette survival").run(state);
    EXPECT_TRUE(action("Roulette survival").checked(state));
    type(state, key(Key::digit1));
    EXPECT_TRUE(action("Result").checked(state));
    EXPECT_FALSE(action("Primal").checked(state));
}

TEST(Actions, ExposureStepsAndStaysInRange) {
    ViewerState state = two_panes();
    type(state, character('+'));
    EXPECT_FLOAT_EQ(state.display.tone.exposure, 0.5f);
    type(state, character('-'));
    type(state, character('-'));
    EXPECT_FLOAT_EQ(state.display.tone.exposure, -0.5f);
    for (int i = 0; i < 100; ++i)
        type(state, character('='));
    EXPECT_FLOAT_EQ(state.display.tone.exposure, 10);
    type(state, key(Key::digit0));
    EXPECT_FLOAT_EQ(state.display.tone.exposure, 0);
}

TEST(Actions, TileStepsInAllLinkedPanes) {
    ViewerState state = two_panes();
    type(state, character(']'));
    EXPECT_EQ(state.panes[0].settings.render.tile, 7);
    EXPECT_EQ(state.panes[1].settings.render.tile, 7);
    EXPECT_EQ(state.panes[0].settings.render.method, Method::pt);
    state.linked = false;
    type(state, character('['));
    EXPECT_EQ(state.panes[0].settings.render.tile, 7);
    EXPECT_EQ(state.panes[1].settings.render.tile, 6);
    for (int i = 0; i < 40; ++i)
        type(state, character('['));
    EXPECT_EQ(state.panes[1].settings.render.tile, 1);
}

TEST(Actions, TheSampleFormShowsTheInspectedSample) {
    ViewerState state = two_panes();
    state.active().settings.render.seed = 5;
    type(state, {Key::i, true, false, 0});
    EXPECT_TRUE(state.layout.sample_form.show);
    EXPECT_EQ(state.layout.sample_form.seed, 5u);
    PassOrigin origin{};
    origin.settings.seed = 9;
    state.inspector.choose({0, {3, 4}, 2, std::make_shared<const PassOrigin>(origin)});
    state.layout.sample_form.show = false;
    type(state, {Key::i, true, false, 0});
    EXPECT_EQ(state.layout.sample_form.pixel, glm::ivec2(3, 4));
    EXPECT_EQ(state.layout.sample_form.pass, 2);
    EXPECT_EQ(state.layout.sample_form.seed, 9u);
}

TEST(Actions, TextEntryBlocksShortcuts) {
    ViewerState state = two_panes();
    type(state, key(Key::r), true);
    type(state, key(Key::digit2), true);
    type(state, character('+'), true);
    EXPECT_FALSE(state.wishes.restart);
    EXPECT_EQ(state.panes[0].settings.buffer, Buffer::reconstruction);
    EXPECT_FLOAT_EQ(state.display.tone.exposure, 0);
    type(state, {Key::q, true, false, 0}, true);
    EXPECT_TRUE(state.wishes.quit);
}

TEST(Actions, CameraGoesHomeAndFliesWithKeys) {
    ViewerState state = two_panes();
    state.camera.set_home({}, {0, 0, 3}, 1);
    Keyboard keyboard;
    EXPECT_FALSE(fly_with_keys(keyboard, 0.1f, state));
    keyboard.press(Key::w, Key::w, false, false);
    EXPECT_TRUE(fly_with_keys(keyboard, 0.1f, state));
    const float walked = state.camera.position().z;
    EXPECT_GT(walked, 0);
    keyboard.press(Key::shift, Key::shift, false, true);
    fly_with_keys(keyboard, 0.1f, state);
    EXPECT_GT(state.camera.position().z - walked, 2 * walked);
    keyboard.release(Key::w);
    keyboard.press(Key::left, Key::left, false, false);
    EXPECT_TRUE(fly_with_keys(keyboard, 0.1f, state));
    EXPECT_GT(state.camera.forward().x, 0); // the left of an unrotated camera is +x
    type(state, key(Key::home));
    EXPECT_EQ(state.camera.position(), glm::vec3(0));
}

TEST(Messages, DroppingTheLastErrorClosesTheList) {
    using Kind = Message::Kind;
    using Origin = Message::Origin;
    ViewerState state = two_panes();
    state.add_message(Kind::note, "of the viewer");
    state.add_message(Kind::note, "of the scene", Origin::scene);
    EXPECT_FALSE(state.layout.show_messages);
    state.add_message(Kind::error, "of a load", Origin::failed_load);
    EXPECT_TRUE(state.layout.show_messages);
    state.drop_messages(Origin::scene);
    EXPECT_TRUE(state.layout.show_messages); // an error remains
    state.drop_messages(Origin::failed_load);
    EXPECT_FALSE(state.layout.show_messages);
    ASSERT_EQ(state.messages.size(), 1u);
    EXPECT_EQ(state.messages[0].text, "of the viewer");
    state.layout.show_messages = true; // as if the user had opened it
    state.drop_messages(Origin::scene);
    EXPECT_TRUE(state.layout.show_messages);
}

TEST(Messages, TheOldestAreDroppedBeyondTheLimit) {
    ViewerState state = two_panes();
    for (int i = 0; i < 5000; ++i)
        state.add_message(Message::Kind::note, std::to_string(i));
    EXPECT_LE(state.messages.size(), 2000u);
    EXPECT_EQ(state.messages.back().text, "4999");
}

TEST(Actions, FitUndoesZoom) {
    ViewerState state = two_panes();
    state.display.view.zoom_at({10, 10}, 4, {100, 100}, {100, 100});
    type(state, key(Key::f));
    EXPECT_EQ(state.display.view, ImageView());
}

} // namespace
} // namespace tessera
