#include "ui/state/actions.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Keyboard, KeepsATapWithinOneFrame) {
    Keyboard keyboard;
    keyboard.press(Key::q, Key::q, true, false);
    keyboard.release(Key::q);
    const auto typed = keyboard.take();
    ASSERT_EQ(typed.size(), 1u);
    EXPECT_EQ(typed[0], (Shortcut{Key::q, true, false, 0}));
    EXPECT_FALSE(keyboard.is_down(Key::q));
    EXPECT_TRUE(keyboard.take().empty());
}

TEST(Keyboard, HeldKeysUsePositionsAndShortcutsUseLabels) {
    Keyboard keyboard;
    keyboard.press(Key::w, Key::z, false, false); // a French keyboard
    EXPECT_TRUE(keyboard.is_down(Key::w));
    EXPECT_EQ(keyboard.take().at(0).key, Key::z);
    keyboard.release_all();
    EXPECT_FALSE(keyboard.is_down(Key::w));
}

TEST(Keyboard, CtrlKeysAreNotHeld) {
    Keyboard keyboard;
    keyboard.press(Key::s, Key::s, true, false);
    EXPECT_FALSE(keyboard.is_down(Key::s));
}

TEST(Keyboard, UnknownKeysAreIgnored) {
    Keyboard keyboard;
    keyboard.press(Key::none, Key::none, false, false);
    EXPECT_FALSE(keyboard.is_down(Key::none));
    EXPECT_TRUE(keyboard.take().empty());
}

TEST(Keyboard, KeysAreNamedByTheirLabel) {
    EXPECT_EQ(key_named("z", Key::w, false), Key::z);           // French
    EXPECT_EQ(key_named("5", Key::digit2, false), Key::digit5); // digits at other positions
    EXPECT_EQ(key_named("w", Key::none, false), Key::w);        // Dvorak: a letter in the place of punctuation
    EXPECT_EQ(key_named("\u0446", Key::w, false), Key::w);      // a letter of another alphabet: by position
    EXPECT_EQ(key_named("\u00e9", Key::digit2, false), Key::digit2);
    EXPECT_EQ(key_named(nullptr, Key::f1, false), Key::f1);
    EXPECT_EQ(key_named("8", Key::digit8, true), Key::none); // German: Alt makes it a bracket
}

TEST(Keyboard, ACharacterBelongsToThePreviousKey) {
    Keyboard keyboard;
    keyboard.press(Key::digit6, Key::digit6, false, false);
    keyboard.type('-');
    keyboard.type('-'); // repeated by a held key
    keyboard.press(Key::a, Key::a, false, false);
    EXPECT_EQ(keyboard.take().size(), 3u);
    keyboard.type('+'); // of a key pressed in an earlier frame
    const auto typed = keyboard.take();
    ASSERT_EQ(typed.size(), 1u);
    EXPECT_EQ(typed[0], (Shortcut{Key::none, false, false, '+'}));
}

TEST(Keyboard, ACharacterShortcutReplacesItsKey) {
    ViewerState state;
    state.panes.resize(1);
    const auto type = [&](Key key, char character) {
        Keyboard keyboard;
        keyboard.press(key, key, false, false);
        if (character)
            keyboard.type(character);
        run_shortcuts(keyboard.take(), false, state);
    };
    type(Key::digit6, '-'); // French: exposure, not the buffer of failed shifts
    EXPECT_LT(state.display.tone.exposure, 0);
    EXPECT_EQ(state.panes[0].settings.buffer, Buffer::reconstruction);
    type(Key::digit3, '"'); // a character without a shortcut
    EXPECT_EQ(state.panes[0].settings.buffer, Buffer::dx);
    const int tile = state.panes[0].settings.render.tile;
    type(Key::digit8, '['); // German, if Alt were not reported
    EXPECT_EQ(state.panes[0].settings.render.tile, tile - 1);
    EXPECT_EQ(state.panes[0].settings.buffer, Buffer::dx);
}

TEST(Keyboard, ShortcutsAreShownByLabel) {
    EXPECT_EQ(to_string(Shortcut{Key::q, true, false, 0}), "Ctrl+Q");
    EXPECT_EQ(to_string(Shortcut{Key::m, false, true, 0}), "Shift+M");
    EXPECT_EQ(to_string(Shortcut{Key::f12, false, false, 0}), "F12");
    EXPECT_EQ(to_string(Shortcut{Key::home, false, false, 0}), "Home");
    EXPECT_EQ(to_string(Shortcut{Key::digit0, false, false, 0}), "0");
    EXPECT_EQ(to_string(Shortcut{Key::none, false, false, '?'}), "?");
    EXPECT_EQ(key_of_character('Q'), Key::q);
    EXPECT_EQ(key_of_character('7'), Key::digit7);
    EXPECT_EQ(key_of_character('?'), Key::none);
}

} // namespace
} // namespace tessera
