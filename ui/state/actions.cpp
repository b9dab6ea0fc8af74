#include "ui/state/actions.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr int place(Key key) {
    return static_cast<int>(key);
}

std::string name(Key key) {
    if (key >= Key::a && key <= Key::z)
        return std::string(1, static_cast<char>('A' + place(key) - place(Key::a)));
    if (key >= Key::digit0 && key <= Key::digit9)
        return std::string(1, static_cast<char>('0' + place(key) - place(Key::digit0)));
    if (key >= Key::f1 && key <= Key::f12)
        return "F" + std::to_string(1 + place(key) - place(Key::f1));
    static constexpr std::array names = {"Left",  "Right", "Up",  "Down",  "Home",
                                         "Space", "Tab",   "Esc", "Shift", "Return"};
    static_assert(names.size() == static_cast<std::size_t>(place(Key::enter) - place(Key::left) + 1));
    const int index = place(key) - place(Key::left);
    return index >= 0 && index < static_cast<int>(names.size()) ? names[index] : "";
}

} // namespace

Key key_of_character(char character) {
    if (character >= 'a' && character <= 'z')
        return static_cast<Key>(place(Key::a) + character - 'a');
    if (character >= 'A' && character <= 'Z')
        return static_cast<Key>(place(Key::a) + character - 'A');
    if (character >= '0' && character <= '9')
        return static_cast<Key>(place(Key::digit0) + character - '0');
    return Key::none;
}

Key key_named(const char* printed, Key place, bool alt) {
    if (alt)
        return Key::none;
    const Key named = printed && *printed && !printed[1] ? key_of_character(*printed) : Key::none;
    return named != Key::none ? named : place;
}

std::string to_string(const Shortcut& shortcut) {
    if (shortcut.character != 0)
        return std::string(1, shortcut.character);
    return (shortcut.ctrl ? "Ctrl+" : "") + std::string(shortcut.shift ? "Shift+" : "") + name(shortcut.key);
}

std::optional<Shortcut> shortcut_named(const std::string& text) {
    Shortcut shortcut;
    std::string rest = text;
    const auto take = [&](const std::string& prefix) {
        const bool found = rest.size() > prefix.size() && rest.rfind(prefix, 0) == 0;
        if (found)
            rest.erase(0, prefix.size());
        return found;
    };
    shortcut.ctrl = take("Ctrl+");
    shortcut.shift = take("Shift+");
    for (int key = place(Key::none) + 1; key < place(Key::count); ++key) {
        if (name(static_cast<Key>(key)) == rest)
            shortcut.key = static_cast<Key>(key);
    }
    if (shortcut.key != Key::none)
        return shortcut;
    if (text.size() == 1 && text[0] > ' ' && key_of_character(text[0]) == Key::none)
        return Shortcut{Key::none, false, false, text[0]};
    return std::nullopt;
}

void Keyboard::press(Key physical, Key named, bool ctrl, bool shift) {
    // A key with Ctrl is a shortcut and does not count as held: Ctrl+S must not move the camera back.
    down_[static_cast<std::size_t>(physical)] = physical != Key::none && !ctrl;
    if (named != Key::none)
        typed_.push_back({named, ctrl, shift, 0});
    awaits_character_ = named != Key::none;
}

void Keyboard::type(char character) {
    if (std::exchange(awaits_character_, false))
        typed_.back().character = character;
    else
        typed_.push_back({Key::none, false, false, character});
}

void Keyboard::release(Key physical) {
    down_[static_cast<std::size_t>(physical)] = false;
}

std::vector<Shortcut> Keyboard::take() {
    awaits_character_ = false;
    return std::exchange(typed_, {});
}

namespace {

constexpr float fly_speed = 0.45f;   // scene radii per second; not tuned
constexpr float look_speed = 1.1f;   // radians per second; not tuned
constexpr float shift_factor = 4.0f; // on fly_speed, with Shift

constexpr Gesture gesture_table[] = {
    {"Left drag", "Orbit around the surface under the mouse, or around the target where there is none"},
    {"Double click", "Look at the surface under the mouse, and orbit around it"},
    {"Right click", "Menu of the pane"},
    {"Middle drag, Shift + left drag", "Pan: the surface under the mouse follows it"},
    {"Wheel, right drag", "Dolly toward the target or away from it"},
    {"W A S D, Q E", "Fly forward, left, back, right; down, up (Shift: faster)"},
    {"Arrow keys", "Look around"},
    {"B held", "Flicker: the active pane shows the picture it is compared with"},
    {"Ctrl + wheel", "Zoom the pictures of all panes; large pixels show their values"},
    {"Ctrl + left drag", "Pan the pictures of all panes; the camera stays"},
    {"Left button with the path inspector (I)", "Choose the pixel to inspect"},
    {"Left button with the slow motion (J)", "Choose the tile to draw"},
    {"Drag on a legend's colours", "Move an end of the range; double click: automatic range"},
    {"Ctrl + click on a slider", "Type a value"},
};

/// Returns the actions of a typed event. Its character has priority over its key: on a French keyboard '-' is
/// on 6.
std::vector<const Action*> called_by(const Shortcut& typed) {
    const Shortcut as_character{Key::none, false, false, typed.character};
    const Shortcut as_key{typed.key, typed.ctrl, typed.shift, 0};
    for (const Shortcut& shortcut : {as_character, as_key}) {
        std::vector<const Action*> called;
        for (const Action& action : actions())
            if (shortcut != Shortcut{} && (shortcut == action.shortcut || shortcut == action.second_shortcut))
                called.push_back(&action);
        if (!called.empty())
            return called;
    }
    return {};
}

bool counts_in_text(const Shortcut& typed) {
    return typed.ctrl || (typed.key >= Key::f1 && typed.key <= Key::f12);
}

void close_overlays(bool entering_text, ViewerState& state) {
    const bool closes_any = entering_text || // Escape ends it
                            state.layout.show_help || state.layout.show_palette || state.layout.large_charts ||
                            state.layout.show_jobs || state.layout.show_gallery || state.reference_making.show ||
                            state.layout.sample_form.show || state.layout.choosing;
    // Each press cancels one running task: the scene's load, the reference's, then reconstructions.
    const bool loads = !state.scene_info.loading.empty();
    const bool is_busy = loads || state.reference_read ||
                         std::any_of(state.panes.begin(), state.panes.end(),
                                     [&](const PaneState& pane) { return state.reconstructs_long(pane); });
    if (!closes_any && !is_busy) {
        state.set_inspector(false);
        state.set_slow_motion(false);
    }
    state.wishes.cancel_scene = state.wishes.cancel_scene || (!closes_any && loads);
    state.wishes.cancel_reference =
        state.wishes.cancel_reference || (!closes_any && !loads && state.reference_read);
    state.wishes.give_up_reconstructions =
        state.wishes.give_up_reconstructions || (!closes_any && !loads && !state.reference_read);
    state.layout.show_help = state.layout.show_palette = false;
    state.layout.large_charts = state.layout.show_jobs = state.layout.show_gallery = false;
    state.reference_making.show = state.layout.sample_form.show = false;
    state.layout.choosing.reset();
}

} // namespace

const Action& action_named(std::string_view name) {
    for (const Action& action : actions())
        if (action.name == name)
            return action;
    throw std::invalid_argument("no action is named " + std::string(name));
}

std::span<const Gesture> gestures() {
    return gesture_table;
}

void run_shortcuts(std::span<const Shortcut> typed, bool entering_text, ViewerState& state) {
    for (const Shortcut& shortcut : typed) {
        if (entering_text && !counts_in_text(shortcut))
            continue;
        if (entering_text && (shortcut.key == Key::z || shortcut.key == Key::y) && shortcut.ctrl)
            continue; // undo and redo of the text field
        for (const Action* action : called_by(shortcut))
            action->run(state);
    }
    if (std::find(typed.begin(), typed.end(), Shortcut{Key::escape}) != typed.end())
        close_overlays(entering_text, state);
}

bool fly_with_keys(const Keyboard& keyboard, float seconds, ViewerState& state) {
    const auto axis = [&](Key plus, Key minus) {
        return static_cast<float>(keyboard.is_down(plus)) - static_cast<float>(keyboard.is_down(minus));
    };
    const glm::vec3 steps(axis(Key::a, Key::d), axis(Key::e, Key::q), axis(Key::w, Key::s));
    const glm::vec2 turns(axis(Key::left, Key::right), axis(Key::up, Key::down));
    const float speed = keyboard.is_down(Key::shift) ? shift_factor : 1.0f;
    if (steps != glm::vec3(0))
        state.camera.fly(steps * (fly_speed * speed * seconds));
    if (turns != glm::vec2(0))
        state.camera.look(turns.x * look_speed * seconds, turns.y * look_speed * seconds);
    return steps != glm::vec3(0) || turns != glm::vec2(0);
}

} // namespace tessera
