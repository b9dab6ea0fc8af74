#include "ui/keyboard.h"

#include <array>
#include <utility>

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
    static constexpr std::array names = {"Left", "Right", "Up", "Down", "Home", "Space", "Tab", "Esc", "Shift"};
    const int index = place(key) - place(Key::left);
    return index >= 0 && index < static_cast<int>(names.size()) ? names[static_cast<std::size_t>(index)] : "";
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
    // With Ctrl it is a shortcut, and does not count as held: Ctrl+S must not fly back.
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

} // namespace tessera
