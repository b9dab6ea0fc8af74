#pragma once

#include "ui/keyboard.h"
#include "ui/viewer_state.h"

#include <span>
#include <vector>

namespace tessera {

/// One thing that the viewer can be told. The menu, the shortcuts and the help page are made of the table of
/// these.
struct Action {
    const char* menu;
    const char* name;
    const char* help;
    Shortcut shortcut;
    Shortcut second_shortcut; ///< Key::none and no character: none
    void (*run)(ViewerState&);
    bool (*checked)(const ViewerState&); ///< null where there is nothing to be on or off
};

/// In the order of the menus.
std::span<const Action> actions();

/// How the mouse and the held keys move camera and picture, for the help page.
struct Gesture {
    const char* input;
    const char* help;
};
std::span<const Gesture> gestures();

/// Runs what was typed. While text is being entered, only shortcuts with Ctrl and function keys count.
void run_shortcuts(std::span<const Shortcut> typed, bool entering_text, ViewerState& state);

/// Moves the camera by the keys that are held, during `seconds`. Tells whether any is.
bool fly_with_keys(const Keyboard& keyboard, float seconds, ViewerState& state);

} // namespace tessera
