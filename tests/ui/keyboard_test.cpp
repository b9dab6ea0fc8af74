#include "ui/keyboard.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Keyboard, KeepsATapBetweenTwoFrames) {
    Keyboard keyboard;
    keyboard.press(Key::q, Key::q, true, false);
    keyboard.release(Key::q);
    const auto typed = keyboard.take();
    ASSERT_EQ(typed.size(), 1u);
    EXPECT_EQ(typed[0], (Shortcut{Key::q, true, false, 0}));
    EXPECT_FALSE(keyboard.is_down(Key::q));
    EXPECT_TRUE(keyboard.take().empty());
}

TEST(Keyboard, HoldsByPlaceAndNamesByPrint) {
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

TEST(Keyboard, ShortcutsReadAsPrinted) {
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
