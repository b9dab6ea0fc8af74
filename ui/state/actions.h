#pragma once

#include "ui/state/viewer_state.h"

#include <algorithm>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Keys that the viewer knows. Letters and digits follow each other.
// clang-format off
enum class Key : std::uint8_t {
    none,
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit0, digit1, digit2, digit3, digit4, digit5, digit6, digit7, digit8, digit9,
    left, right, up, down, home, space, tab, escape, shift, enter,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
    count
};
// clang-format on

/// The letter's or digit's key (either case); Key::none for others.
Key key_of_character(char character);

/// What a key is called: by the letter or digit printed on it, which the system tells in UTF-8 (null: it does not
/// know), else by its place on an American keyboard. With Alt of either side, no key is meant: on many keyboards
/// that one makes brackets of digits.
Key key_named(const char* printed, Key place, bool alt);

/// What calls an action: a key with its modifiers, or a character however the keyboard makes it ('?'). What was
/// typed may be both: a key, and the character that it has made.
struct Shortcut {
    Key key = Key::none;
    bool ctrl = false;
    bool shift = false;
    char character = 0;

    bool operator==(const Shortcut&) const = default;
};

/// "Ctrl+Q", "F1", "?", "Space".
std::string to_string(const Shortcut& shortcut);

/// The shortcut of that name; also "Up" or "Ctrl+Shift+K", and a character that is neither letter nor digit.
/// Nothing: there is none.
std::optional<Shortcut> shortcut_named(const std::string& name);

/// What was typed since the last frame, and what is held. Own bookkeeping, not Dear ImGui's: its older versions
/// lose a key that goes down and up between two frames, which happens when the processors are busy.
class Keyboard {
public:
    /// A key went down. `physical` is the place on an American keyboard, `named` what is printed on it.
    void press(Key physical, Key named, bool ctrl, bool shift);
    void release(Key physical);
    /// A character came, that of the key which went down just before, if one did.
    void type(char character);
    void release_all() { down_.reset(); }

    /// Whether the key is held now, by its place, so that W A S D lie alike on all keyboards.
    bool is_down(Key physical) const { return down_[static_cast<std::size_t>(physical)]; }

    /// What was pressed and typed since the last take, in order.
    std::vector<Shortcut> take();

private:
    std::bitset<static_cast<std::size_t>(Key::count)> down_;
    std::vector<Shortcut> typed_;
    bool awaits_character_ = false; // the last of these may have made one
};

/// One thing that the viewer can be told. The menus, the shortcuts, the list of commands and the help page are
/// made of the table of these.
struct Action {
    const char* menu; ///< or the group's name, where no menu has it
    const char* name;
    const char* help;
    Shortcut shortcut; ///< Key::none and no character: none, as of the next
    Shortcut second_shortcut;
    void (*run)(ViewerState&);
    bool (*checked)(const ViewerState&); ///< null where there is nothing to be on or off
};

/// All actions, in the order of the menus.
std::span<const Action> actions();
/// Whether it is in a menu of the menu bar: what is seldom wanted, or has buttons where it belongs, is found in
/// the list of commands and the help page alone.
bool is_in_menu(const Action& action);
/// The one of that name. Throws std::invalid_argument where there is none.
const Action& action_named(std::string_view name);

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

// What the actions of the table do that takes more than a line.

void set_buffer(ViewerState& state, Buffer buffer); ///< in all panes
void step_method(ViewerState& state, int step);     ///< of the active pane
void step_tile(ViewerState& state, int step);
/// From the whole of coefficients to their first part, and so on through all that some pane has.
void next_part(ViewerState& state);
/// Switches a pane between raw samples and the denoiser of its method: `guided` with gradients, `smoothed` without.
/// Unlinks the panes if there are several, because the reconstruction then differs between them.
void toggle_denoiser(ViewerState& state, int pane);
/// Four panes of the active one's samples: the primal, and what L1, the weighted norm and guides make of them.
void compare_reconstructions(ViewerState& state);
void step_exposure(ViewerState& state, float stops);
void step_pass(ViewerState& state);
void step_ui_scale(ViewerState& state, float by);
void next_pane(ViewerState& state);
void add_bookmark(ViewerState& state);    ///< of the view on show
void next_bookmark(ViewerState& state);   ///< goes to it; nothing where there is none
void forget_bookmark(ViewerState& state); ///< the one that was gone to or made last
void next_grid(ViewerState& state);
void next_tone(ViewerState& state);
void next_tile(ViewerState& state);     ///< of the slow motion
void toggle_charts(ViewerState& state); ///< hidden, they are not drawn large either
void toggle_inspector(ViewerState& state);
void open_sample_form(ViewerState& state); ///< with the sample that is looked at
void toggle_slow_motion(ViewerState& state);
void toggle_comparison(ViewerState& state, Comparison::Kind kind);

template <Buffer buffer>
void show_buffer(ViewerState& state) {
    set_buffer(state, buffer);
}

template <Buffer buffer>
bool shows_buffer(const ViewerState& state) {
    return std::all_of(state.panes.begin(), state.panes.end(),
                       [](const PaneState& pane) { return pane.settings.buffer == buffer; });
}

template <int count>
void set_panes(ViewerState& state) {
    state.set_pane_count(count);
}

template <int count>
bool has_panes(const ViewerState& state) {
    return state.panes.size() == count;
}

template <Comparison::Kind kind>
bool compares(const ViewerState& state) {
    return state.active().settings.comparison.kind == kind;
}

template <Comparison::Kind kind>
void toggle(ViewerState& state) {
    toggle_comparison(state, kind);
}

} // namespace tessera
