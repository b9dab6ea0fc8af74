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

/// Keys of the keyboard. Letters, digits and function keys have consecutive values.
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

/// Returns the key of a letter, in either case, or of a digit; Key::none for other characters.
Key key_of_character(char character);

/// Returns the key that was pressed: the letter or digit printed on it, or else its place on a US keyboard.
/// Returns Key::none with Alt, because many layouts use Alt and digits for brackets.
/// @param printed  UTF-8 name from the system; null: unknown
Key key_named(const char* printed, Key place, bool alt);

/// Trigger of an action: a key with modifiers, or a character, whatever keys produce it ('?'). A typed event can
/// hold both, a key and its character.
struct Shortcut {
    Key key = Key::none;
    bool ctrl = false;
    bool shift = false;
    char character = 0;

    bool operator==(const Shortcut&) const = default;
};

/// Returns "Ctrl+Q", "F1", "?" or "Space"; empty without a key and a character.
std::string to_string(const Shortcut& shortcut);

/// Parses a key name such as "Up" or "Ctrl+Shift+K", or a character that is neither letter nor digit. Empty: no
/// shortcut has this name.
std::optional<Shortcut> shortcut_named(const std::string& name);

/// Records key presses, typed characters and held keys. Dear ImGui's own key state is not used: older versions
/// lose a key that goes down and up between two frames, which happens under load.
class Keyboard {
public:
    /// Records a key press. `physical` is the key's place on a US keyboard, `named` its printed label.
    void press(Key physical, Key named, bool ctrl, bool shift);
    void release(Key physical);
    /// Records a character. It belongs to the key that was pressed just before, if there is one.
    void type(char character);
    void release_all() { down_.reset(); }

    /// Whether the key at this place of a US keyboard is held. So W A S D are neighbours on every layout.
    bool is_down(Key physical) const { return down_[static_cast<std::size_t>(physical)]; }

    /// Returns the presses and characters since the previous call, in order.
    std::vector<Shortcut> take();

private:
    std::bitset<static_cast<std::size_t>(Key::count)> down_;
    std::vector<Shortcut> typed_;
    bool awaits_character_ = false; // the next character belongs to the last of typed_
};

/// A command of the viewer. Menus, shortcuts, command palette and help page are built from the table of actions.
struct Action {
    const char* menu; ///< title of the menu, or of the group on the help page
    const char* name;
    const char* help;
    Shortcut shortcut; ///< without key and character: none; likewise second_shortcut
    Shortcut second_shortcut;
    void (*run)(ViewerState&);
    bool (*checked)(const ViewerState&); ///< whether a toggle is on; null: not a toggle
};

/// Returns all actions in the order of the menus.
std::span<const Action> actions();
/// Whether the action is in the menu bar. Rare actions, and actions with buttons elsewhere, are only in the
/// command palette and on the help page.
bool is_in_menu(const Action& action);
/// Returns the action with this name. Throws std::invalid_argument if there is none.
const Action& action_named(std::string_view name);

/// A mouse gesture or held key, and its effect, for the help page.
struct Gesture {
    const char* input;
    const char* help;
};
std::span<const Gesture> gestures();

/// Runs the actions of the typed shortcuts; Escape closes overlays or cancels a running task. During text input
/// only function keys and shortcuts with Ctrl count, except Ctrl+Z and Ctrl+Y.
void run_shortcuts(std::span<const Shortcut> typed, bool entering_text, ViewerState& state);

/// Moves the camera by the held keys for a frame of `seconds`. Returns whether it moved.
bool fly_with_keys(const Keyboard& keyboard, float seconds, ViewerState& state);

// The functions of actions that take more than a line.

void set_buffer(ViewerState& state, Buffer buffer); ///< in all panes
void step_method(ViewerState& state, int step);     ///< of the active pane
void step_tile(ViewerState& state, int step);
/// Shows the next basis component that some pane has, or the whole after the last one.
void next_component(ViewerState& state);
/// Switches a pane between raw samples and the denoiser of its method: `guided` with gradients, `smoothed`
/// without. Unlinks the panes if there are several, because the reconstruction then differs between them.
void toggle_denoiser(ViewerState& state, int pane);
/// Shows four reconstructions of the active pane's samples: raw samples, L1, weighted and guided. A method
/// without gradients becomes G-PR.
void compare_reconstructions(ViewerState& state);
void step_exposure(ViewerState& state, float stops);
void step_pass(ViewerState& state);
void step_ui_scale(ViewerState& state, float by);
void next_pane(ViewerState& state);
void add_bookmark(ViewerState& state);
void next_bookmark(ViewerState& state);   ///< moves the camera there; a message if there is none
void forget_bookmark(ViewerState& state); ///< deletes the one that was visited or added last
void next_grid(ViewerState& state);
void next_tone(ViewerState& state);
void next_tile(ViewerState& state);     ///< of the slow motion
void toggle_charts(ViewerState& state); ///< hides the large charts, too
void toggle_inspector(ViewerState& state);
void open_sample_form(ViewerState& state); ///< filled with the inspected sample
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
